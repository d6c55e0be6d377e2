#include "engine/mesh/sample_shapes.h"
#include "tests/support/forging.h"
#include "tests/support/refine_checks.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

using namespace anvil;
using namespace anvil::test;

namespace {

/// Splits the worst edge of all, again and again: slow, and with nothing to join or to hurry.
class Greedy {
  public:
    Greedy(const Mesh& mesh, HandleField handle)
        : state_(state_of(mesh, {std::move(handle)})), triangles_(mesh.triangles) {}

    size_t run(double tolerance) {
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            add(t);
        }
        while (!queue_.empty() && queue_.rbegin()->first > tolerance) {
            const Ends edge = queue_.rbegin()->second;
            split(edge);
        }
        return state_.parents.size();
    }

  private:
    using Ends = std::pair<uint32_t, uint32_t>;

    void add(uint32_t t) {
        for (int i = 0; i < 3; ++i) {
            const Ends ends = std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]);
            auto& faces = faces_of_[ends];
            faces.insert(t);
            if (faces.size() == 1) {
                EdgeMeasure measure(state_.handles[0]);
                const double length =
                    glm::distance(state_.positions[ends.first], state_.positions[ends.second]);
                found_[ends] = measure.worst({ends.first, ends.second, length}, 1e-9);
                queue_.insert({found_[ends].error, ends});
            }
        }
    }

    void remove(uint32_t t) {
        for (int i = 0; i < 3; ++i) {
            const Ends ends = std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]);
            faces_of_[ends].erase(t);
            if (faces_of_[ends].empty()) {
                queue_.erase({found_[ends].error, ends});
                faces_of_.erase(ends);
            }
        }
    }

    void split(Ends edge) {
        const uint32_t middle = state_.add_vertex({edge.first, edge.second, found_[edge].place});
        const std::set<uint32_t> faces = faces_of_[edge];
        for (const uint32_t t : faces) {
            remove(t);
            Triangle other = triangles_[t];
            std::replace(other.begin(), other.end(), edge.first, middle);
            std::replace(triangles_[t].begin(), triangles_[t].end(), edge.second, middle);
            triangles_.push_back(other);
            add(t);
            add(static_cast<uint32_t>(triangles_.size() - 1));
        }
    }

    RefineState state_;
    std::vector<Triangle> triangles_;
    std::map<Ends, std::set<uint32_t>> faces_of_;
    std::map<Ends, EdgeError> found_;
    std::set<std::pair<double, Ends>> queue_;
};

} // namespace

TEST_CASE("A plateau takes at most 1.5 times the vertices that splitting the worst edge of all takes") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> shake(-0.02, 0.02);
    for (const size_t vertices : {121U, 400U}) {
        for (const double radius : {0.2, 0.33}) {
            Mesh mesh = make_sample("plane", vertices);
            for (Vec3& p : mesh.positions) {
                if (std::max(std::abs(p.x), std::abs(p.y)) < 0.49) {
                    p += Vec3(shake(random), shake(random), 0);
                }
            }
            const HandleField handle =
                field_from(mesh, {nearest_vertex(mesh, {0.02, 0.01, 0})}, "plateau", radius);
            const double tolerance = 0.01;
            Progress progress;
            const auto criterion = make_shape_criterion();
            const Refinement result = refine(mesh.triangles, state_of(mesh, {handle}), *criterion,
                                             {tolerance, 0, 100000}, progress);
            const size_t greedy = Greedy(mesh, handle).run(tolerance);
            INFO("plane of " << vertices << ", R " << radius << ": " << result.report.added << " for "
                             << greedy);
            CHECK(greedy > 100);
            CHECK(result.report.added <= 1.5 * greedy);
        }
    }
}
