// An editing session without a window: a recipe, what it makes of its mesh, and every state before.
#pragma once

#include "engine/core/file_cache.h"
#include "engine/document/version_store.h"
#include "engine/edit/recipe.h"
#include "engine/forge/edit_occluders.h"
#include "engine/mesh/mesh_writer.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace anvil {

/// A recipe's mesh is not where the recipe says: ask for it, and open the recipe with its new path.
class MissingMesh : public InputError {
  public:
    MissingMesh(const std::filesystem::path& recipe, std::filesystem::path mesh);

    const std::filesystem::path& mesh() const { return mesh_; } ///< where it should be

  private:
    std::filesystem::path mesh_;
};

struct DocumentOptions {
    size_t budget = size_t{512} << 20; ///< bytes for the surfaces of former states, see VersionStore
    const FileCache* fields = nullptr; ///< where baked fields are kept, if anywhere
};

/// What other threads may look at while the session goes on.
struct DocumentState {
    std::shared_ptr<const Recipe> recipe;
    std::shared_ptr<const SurfaceVersion> surface; ///< after all edits of the recipe
    std::string undo;                              ///< what undo() would take back; empty: nothing
    std::string redo;
    bool unsaved = false;
    std::set<std::string> off; ///< occluders that are switched off
};

/// The recipe is the whole state: each step of the history is a recipe, and the surface is what forge() makes
/// of it with the same back end, bit for bit, whichever way the session came there. Paths in recipes are
/// absolute as long as they are in here.
/// For one thread at a time. A call that throws leaves all as it was. Long ones report to `work.progress` and
/// can be cancelled; warnings go to `work.log`.
class Document {
  public:
    /// Opens a mesh, with a recipe that does nothing yet, or a recipe (a file that ends in .json) with its
    /// mesh, and applies its edits. `mesh`, if given, stands in for the recipe's mesh from now on.
    /// @throws MissingMesh, and InputError, DeviceError, Cancelled as read_recipe(), read_mesh() and forge().
    static std::unique_ptr<Document> open(const std::filesystem::path& file, const EditWork& work,
                                          const DocumentOptions& options = {},
                                          const std::filesystem::path& mesh = {});

    /// Opens a recipe that no file has, its paths absolute: `unsaved` until it is saved. Recipe::file is
    /// where it was to be saved, if known. @throws as open().
    static std::unique_ptr<Document> open_unsaved(Recipe recipe, const EditWork& work,
                                                  const DocumentOptions& options = {},
                                                  const std::filesystem::path& mesh = {});

    const Recipe& recipe() const { return *recipe_; }
    /// After all edits.
    std::shared_ptr<const SurfaceVersion> surface() const { return surface_; }
    /// Before edit `index`: what a drag of it starts from. Up to the number of edits.
    std::shared_ptr<const SurfaceVersion> surface_before(size_t index, const EditWork& work);
    DocumentState state() const;

    /// The file's mesh, and where it lies.
    const std::shared_ptr<const Mesh>& mesh() const { return surface_->file; }
    const std::filesystem::path& mesh_file() const { return mesh_file_; }
    /// Where the recipe was read from or saved to last; empty: nowhere yet.
    const std::filesystem::path& recipe_file() const { return recipe_file_; }

    /// Takes the next recipe: one step of the history, `what` is its name for people ("Move handle"). Nothing
    /// happens if it is the same as now. If the last step has the same `merge`, not empty, and nothing was
    /// undone or saved since, this one takes its place: a slider that is dragged is one step.
    /// @throws InputError also for what parse_recipe() would refuse.
    void change(const Recipe& next, const std::string& what, const EditWork& work,
                const std::string& merge = {});

    /// Which occluders are off from here on: one step of the history like another, but none that a file knows
    /// of, since recipes have no word for it. It is for whoever makes the next edits, which name the others
    /// alone; edits that are there are not changed. Names that the recipe does not have are left out.
    void switch_off(std::set<std::string> names, const std::string& what);

    /// The surfaces that the recipe would make, without taking it: of the file, then after each edit; those
    /// that memory does not allow are nullptr, the last one is there. They stay until others are foreseen, so
    /// that change() finds them. @throws as change()
    std::vector<std::shared_ptr<const SurfaceVersion>> foresee(const Recipe& next, const EditWork& work);

    bool can_undo() const { return step_ > 0; }
    bool can_redo() const { return step_ + 1 < steps_.size(); }
    void undo(const EditWork& work);
    void redo(const EditWork& work);

    /// Makes the surface anew with another back end, and all others when they are asked for.
    void change_backend(const EditWork& work);

    /// Whether the recipe says something else than its file.
    bool unsaved() const;
    /// Writes the recipe, with its files named relative to its folder. @throws InputError if it would
    /// overwrite what it reads, WriteError.
    void save_recipe(const std::filesystem::path& file);
    /// Writes the mesh as `anvil forge` does. @throws InputError if it would overwrite what the recipe reads
    /// or the recipe itself, or for an unknown extension; WriteError.
    void save_mesh(const std::filesystem::path& file,
                   OutputPrecision precision = OutputPrecision::automatic) const;

    // For drag sessions on surface_before().

    /// Solvers of the mesh: for DragScene.
    KeptSolvers& solvers() { return versions_.solvers(); }
    /// Occluders of a recipe of this document; models that are known are not built again. `recipe` as
    /// EditOccluders wants it.
    EditOccluders occluders(const Recipe& recipe, const EditWork& work);

    const VersionStore& versions() const { return versions_; }

  private:
    /// One state of the history. Edits that a state shares with the one before are the same objects.
    struct Step {
        std::string what; ///< led here
        std::string merge;
        std::shared_ptr<const std::vector<Occluder>> occluders;
        std::vector<std::shared_ptr<const Edit>> edits;
        VersionStore::Chain chain;
        std::set<std::string> off;
    };

    Document(const Recipe& recipe, std::shared_ptr<const Mesh> mesh, const EditWork& work,
             const DocumentOptions& options);

    Step step_of(const Recipe& recipe, const std::string& what, const std::string& merge);
    std::shared_ptr<const Recipe> recipe_of(const Step& step) const;
    void go_to(size_t step, const EditWork& work);
    void keep_models();
    Recipe checked(const Recipe& next) const;
    void check_target(const std::filesystem::path& file) const;

    DocumentOptions options_;
    std::filesystem::path mesh_file_, recipe_file_;
    VersionStore versions_;
    KeptModels models_;
    VersionStore::Chain foreseen_;
    std::vector<Step> steps_; ///< the first is the state that was opened
    size_t step_ = 0;
    std::shared_ptr<const Recipe> recipe_; ///< of the step
    std::shared_ptr<const SurfaceVersion> surface_;
    std::optional<Recipe> saved_; ///< what the file says, its paths absolute; nothing: it is not this one
};

/// The edit with all its occluders written out, each with its pose: moving an occluder later does not change
/// it.
Edit with_poses(const Recipe& recipe, Edit edit);

} // namespace anvil
