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

  private:
    ScratchFolder folder_;
};

} // namespace anvil
