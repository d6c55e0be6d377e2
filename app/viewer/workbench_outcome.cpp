#include "app/viewer/conditioning.h"
#include "app/viewer/workbench.h"

namespace anvil {

void Workbench::look_ahead(const Edit& edit, Progress& progress) {
    Recipe next = document().recipe();
    next.edits.push_back(with_poses(next, edit));
    const std::shared_ptr<const SurfaceVersion> after = document().foresee(next, work(progress)).back();
    Shown shown_next = *shown();
    shown_next.outcome = Outcome{after->report, after->mesh->vertex_count(),
                                 std::make_shared<DrawnMesh>(device_->state(), *after->mesh, after->positions,
                                                             after->frame.origin, false)};
    publish(shown_next);
}

/// Edits that are new or that were changed; what a file brought along is its author's.
void Workbench::refuse_ill_conditioned_edits(const Recipe& next, Progress& progress) {
    const std::vector<Edit>& now = document().recipe().edits;
    const auto made = document().foresee(next, work(progress));
    for (size_t i = 0; i < next.edits.size() && i + 1 < made.size(); ++i) {
        const bool stays = i < now.size() && now[i] == next.edits[i];
        if (!stays && made[i + 1] != nullptr) {
            const EditReport& report = made[i + 1]->report;
            refuse_ill_conditioned(report.condition, report.amplification, "edit " + std::to_string(i + 1));
        }
    }
}

} // namespace anvil
