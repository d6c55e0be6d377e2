// The surfaces of an editing session: each made once, shared by all recipes that begin alike, within a
// budget of memory.
#pragma once

#include "engine/forge/apply_edit.h"

#include <memory>
#include <string>
#include <vector>

namespace anvil {

/// What making a surface needs of the caller.
struct EditWork {
    Backend& backend;
    Log& log;
    Progress& progress;
};

class VersionStore {
  public:
    /// A place in the tree of edits: the file's mesh, or an edit after another place. Who holds a place keeps
    /// all those before it.
    struct Place;
    /// The file's mesh, then the surface after each edit.
    using Chain = std::vector<std::shared_ptr<Place>>;

    /// `budget`, bytes: beyond it, surfaces that were not used for longest shrink to what their edit changed,
    /// from which they are put together; if that is too much as well, it is let go of, and the edit is
    /// applied again. The surface of the file and the one last asked for stay.
    VersionStore(std::shared_ptr<const Mesh> file, size_t budget);

    /// The places of a recipe's edits. Edits that say the same, with the same occluders in the same poses,
    /// after the same edits, are one place.
    Chain chain_of(const Recipe& recipe);

    /// The surface at chain[index], made from one after it that is there, or else from the nearest one before
    /// it that is there as a whole and that the same back end made. The chain is that of the recipe that the
    /// occluders are of.
    /// @throws InputError, DeviceError, Cancelled as apply_edit() does.
    std::shared_ptr<const SurfaceVersion> version(const Chain& chain, size_t index,
                                                  const EditOccluders& occluders, const EditWork& work);

    /// The same if it is there, whoever made it; else nothing.
    static std::shared_ptr<const SurfaceVersion> version_at_hand(const Chain& chain, size_t index);

    /// What all surfaces that are kept take.
    size_t bytes() const;
    size_t budget() const { return budget_; }

    /// How often an edit was applied.
    size_t edits_applied() const { return edits_applied_; }

    KeptSolvers& solvers() { return solvers_; }

  private:
    std::vector<std::shared_ptr<Place>> live() const;
    bool take_back_to(const std::shared_ptr<Place>& place, const std::string& maker);
    void keep_within_budget(const Place& pinned);
    std::shared_ptr<Place> oldest(const Place& pinned, bool can_be_put_together) const;

    std::shared_ptr<Place> file_;
    std::vector<std::weak_ptr<Place>> places_;
    size_t budget_;
    KeptSolvers solvers_;
    uint64_t clock_ = 0;
    size_t edits_applied_ = 0;
};

} // namespace anvil
