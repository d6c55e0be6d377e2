// What forging a recipe did, as plain data; report_json writes it with the stable keys that scripts rely on.
#pragma once

#include "engine/deform/contact_finish.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// Wall seconds of the stages, over all edits.
struct StageSeconds {
    double load = 0;
    double distance = 0;
    double solve = 0;
    double refine = 0;
    double bake = 0;
    double upload = 0;
    double deform = 0;
    double download = 0;
    double write = 0;

    StageSeconds& operator+=(const StageSeconds& more);
};

struct StepCounts {
    uint32_t min = 0;
    double mean = 0;
    uint32_t max = 0;
    size_t limit_reached = 0; ///< vertices stopped by the step limit
};

struct VolumeChange {
    double before = 0;
    double after = 0;
    std::optional<double> without_occluders{}; ///< of an edit with dilation: what it would be
};

struct DilationReport {
    double width = 0;
    double height = 0; ///< what the steps raised at most, summed over them
    bool solved = false;
};

/// What refinement did; angles in degrees, of the triangles in the region before the edit moved them.
struct RefineSummary {
    size_t added = 0;
    double max_error =
        0; ///< of the edges that remain and are not parted, or a bound of it; in the criterion's unit
    size_t parted_edges =
        0; ///< left apart by more than the tolerance, since the edit tears the surface there
    double parted_error = 0;
    std::string stopped_by; ///< "tolerance", "min_edge", "max_vertices" or "parting"
    double min_angle_before = 0;
    double min_angle_after = 0;
};

/// What touches an occluder at the end of an edit, by the numbers of the mesh that it left: the file's own,
/// until refinement adds some.
struct ContactList {
    std::string name;               ///< of the occluder
    std::vector<uint32_t> vertices; ///< ascending
    /// Face and triangle of its triangulation, ascending.
    std::vector<std::array<uint32_t, 2>> triangles;
};

struct EditReport {
    std::string kind;  ///< "translate" or "rotate"
    size_t region = 0; ///< vertices that the edit can move
    size_t moved = 0;  ///< vertices whose position changed
    int rank = 0;
    double condition = 0;
    double amplification = 0;
    std::vector<double> target_errors;         ///< per handle, world units, of the constraint system
    std::vector<double> radii;                 ///< per handle, world units
    std::vector<std::string> distance_methods; ///< per handle: "approximate", "exact" or "euclidean"
    StepCounts steps;
    size_t samples = 0;
    std::optional<RefineSummary> refine;  ///< absent where the edit does not refine
    std::optional<ContactReport> contact; ///< absent without occluders
    std::vector<ContactList> contacts;    ///< one per use of an occluder
    std::optional<VolumeChange> volume;   ///< absent for open meshes
    std::optional<DilationReport> dilation;
};

struct ForgeReport {
    std::string device;
    std::string driver;
    size_t vertices = 0;
    size_t faces = 0;
    StageSeconds seconds;
    std::vector<EditReport> edits;
    std::vector<std::string> warnings;
};

/// JSON text of the report, 2 spaces of indentation, numbers that round trip; what is not finite is null.
/// Every edit has every key: without occluders the counts of `occluder` are 0, without refinement those of
/// `refine` (and its angles and reason are null); `volume` and `dilation` are null where there is none.
std::string report_json(const ForgeReport& report);

} // namespace anvil
