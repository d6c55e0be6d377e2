// Two hundred drags of a mesh, all undone and done again: what they hold in memory, and how long a step
// takes.
//   bench_undo MESH [VERTICES IN THE REGION] [BUDGET, MiB]
#include "engine/core/error.h"
#include "engine/document/document.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>

using namespace anvil;

namespace {

constexpr size_t drag_count = 200;

struct Times {
    std::vector<double> milliseconds;

    template <class Work>
    void measure(Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        milliseconds.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    void print(const char* what) {
        std::sort(milliseconds.begin(), milliseconds.end());
        std::cout << what << ": median " << milliseconds[milliseconds.size() / 2] << " ms, longest "
                  << milliseconds.back() << " ms\n";
    }
};

/// A radius within which about so many vertices lie, by the mesh's density.
double radius_for(const Document& document, double vertices) {
    Box box;
    for (const Vec3& p : document.mesh()->positions) {
        box.include(p);
    }
    return 0.6 * box.diagonal() * std::sqrt(vertices / static_cast<double>(document.mesh()->vertex_count()));
}

void run(const std::string& mesh, double region, size_t budget) {
    const auto backend = make_cpu_backend();
    Log log;
    Progress progress;
    const EditWork work{*backend, log, progress};
    DocumentOptions options;
    options.budget = budget;
    const auto document = Document::open(mesh, work, options);
    const double radius = radius_for(*document, region);
    const size_t vertices = document->mesh()->vertex_count();
    Times drags;
    Times undos;
    Times redos;
    size_t most = 0;
    size_t reached = 0;
    Recipe recipe = document->recipe();
    for (size_t i = 0; i < drag_count; ++i) {
        Edit edit;
        Handle handle;
        handle.at = VertexAddress{static_cast<uint32_t>((i * 7919) % vertices)};
        handle.by = Vec3(0.02 * radius);
        edit.handles.push_back(handle);
        edit.radius = radius;
        recipe.edits.push_back(edit);
        drags.measure([&] { document->change(recipe, "drag", work); });
        reached += document->surface()->report.region;
        most = std::max(most, document->versions().bytes());
    }
    const std::vector<Vec3> end = document->surface()->positions;
    while (document->can_undo()) {
        undos.measure([&] { document->undo(work); });
        most = std::max(most, document->versions().bytes());
    }
    const bool back = document->surface()->positions == document->mesh()->positions;
    while (document->can_redo()) {
        redos.measure([&] { document->redo(work); });
    }
    std::cout << vertices << " vertices, " << reached / drag_count << " in a region on average, "
              << drag_count << " drags\n"
              << "held at most: " << (most >> 20) << " MiB of " << (budget >> 20) << "\n"
              << "edits applied: " << document->versions().edits_applied() << "\n"
              << "undone to the file's positions: " << (back ? "yes" : "NO")
              << ", done again to the same: " << (document->surface()->positions == end ? "yes" : "NO")
              << "\n";
    drags.print("a drag");
    undos.print("undo");
    redos.print("redo");
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: bench_undo MESH [VERTICES IN THE REGION] [BUDGET, MiB]\n";
        return 2;
    }
    try {
        run(argv[1], argc > 2 ? std::atof(argv[2]) : 10000.0,
            static_cast<size_t>(argc > 3 ? std::atoi(argv[3]) : 512) << 20);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
    return 0;
}
