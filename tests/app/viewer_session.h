// A session of the viewer on a hand, without a person.
#pragma once

#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <string>

namespace anvil {

/// With a folder of its own, also for what the viewer remembers. Wants a display.
class ViewerSession {
  public:
    ViewerSession();

    std::string mesh() const { return folder_ / "hand.ply"; }
    std::string file(const std::string& name) const { return folder_ / name; }

    ProgramRun play(const std::string& script, const std::string& device,
                    const std::string& opens = "") const;

    /// Plays the script, which makes so many edits of the mesh, undoes all and redoes all, and forges the
    /// recipe that it saves: a test failure where the meshes are not the same, bit for bit.
    void check_history(const std::string& script, const std::string& mesh, int edits,
                       const std::string& device) const;

  private:
    ScratchFolder folder_;
};

} // namespace anvil
