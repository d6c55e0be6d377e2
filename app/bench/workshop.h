// What the cases of a run share: back ends, and meshes and fields that are made once.
#pragma once

#include "app/bench/bench_case.h"
#include "engine/core/progress.h"
#include "engine/deform/backend.h"
#include "engine/occluder/occluder_set.h"

#include <map>
#include <memory>

namespace anvil {

/// How large a run is.
struct BenchExtent {
    bool quick = false; ///< fewer cases and smaller meshes: under a minute

    /// Numbers of vertices of the meshes.
    std::vector<size_t> sizes() const {
        return quick ? std::vector<size_t>{100'000} : std::vector<size_t>{100'000, 1'000'000, 4'000'000};
    }
};

class Workshop {
  public:
    /// `tested` outlives it.
    Workshop(Backend& tested, Progress& progress);

    Backend& tested() const { return tested_; }
    Backend& cpu() const { return *cpu_; }
    Backend& float_cpu() const { return *float_cpu_; }

    /// An icosphere of radius 1 with about so many vertices; the last one asked for is kept.
    std::shared_ptr<const Mesh> sphere(size_t vertices);

    enum class Obstacle { analytic, dense, adaptive_field };
    /// A ball by its formula, or a torus from samples (128 voxels); about unit size.
    const OccluderModel& obstacle(Obstacle kind);

  private:
    Backend& tested_;
    Progress& progress_;
    std::unique_ptr<Backend> cpu_;
    std::unique_ptr<Backend> float_cpu_;
    std::map<size_t, std::shared_ptr<const Mesh>> spheres_;
    std::map<Obstacle, OccluderModel> obstacles_;
};

/// The leanest shortest paths along edges, from vertex 0 up to a distance.
Yardstick dijkstra_yardstick(const Mesh& mesh, double radius);

/// memcpy of so many bytes, on all cores as the kernels are.
Yardstick memcpy_yardstick(uint64_t bytes);

/// "100k", "1M": a number of vertices in the name of a case.
std::string size_text(size_t vertices);

// The cases, room by room. `workshop` outlives them.
void add_deform_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);
void add_drag_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);
void add_distance_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);
void add_file_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);
void add_refine_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);
void add_bake_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent);

} // namespace anvil
