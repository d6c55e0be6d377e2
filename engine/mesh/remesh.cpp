#include "engine/mesh/remesh.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/triangle_net.h"

#include <utility>

namespace anvil {

namespace {

constexpr size_t grain = 512;
// Beyond this many vertices quartering replaces remeshing: it is several times as fast and keeps the shapes.
constexpr size_t most_remeshed = 16000;

// Cosine of the angle from its neighbours' mean normal to which a triangle may turn.
constexpr double most_turned = 0.4;
// Sine of the angle below which a triangle is mended (25 degrees).
constexpr double thin = 0.42;

double cosine(const Vec3& a, const Vec3& b) {
    const double lengths = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    return lengths > 0 ? glm::dot(a, b) / lengths : -1;
}

class Remesher {
  public:
    Remesher(const Mesh& mesh, const Projection& project) : net_(mesh), project_(project) {}

    void run(double edge_length, int rounds);
    void quarter();
    double area() const;
    TriangleNet& net() { return net_; }

  private:
    void split_long(double longest);
    void collapse_short(double shortest, double longest);
    void flip_edges();
    void smooth();
    void mend();

    bool mend_face(uint32_t h);
    double least_sine(const Vec3& a, const Vec3& b, const Vec3& c) const;
    double least_sine(uint32_t h) const;
    bool collapse_folds(uint32_t h, double longest) const;
    int valence_gain(uint32_t h) const;
    bool flip_folds(uint32_t h) const;
    Vec3 smoothed(uint32_t v) const;
    bool move_folds(uint32_t v, const Vec3& p) const;

    TriangleNet net_;
    const Projection& project_;
};

void Remesher::run(double edge_length, int rounds) {
    for (int round = 0; round < rounds; ++round) {
        split_long(4.0 / 3 * edge_length);
        collapse_short(0.8 * edge_length, 4.0 / 3 * edge_length);
        flip_edges();
        smooth();
        smooth();
    }
    flip_edges();
    smooth();
    smooth();
    mend();
}

void Remesher::quarter() {
    net_.quarter();
    parallel_for(net_.vertex_slots(), grain, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            net_.positions[v] = project_(net_.positions[v]);
        }
    });
    smooth();
    smooth();
    mend();
}

double Remesher::area() const {
    double sum = 0;
    for (uint32_t h = 0; h < net_.half_edge_count(); h += 3) {
        sum += net_.is_alive(h) ? 0.5 * glm::length(net_.face_normal(h)) : 0;
    }
    return sum;
}

void Remesher::split_long(double longest) {
    const uint32_t count = net_.half_edge_count();
    for (uint32_t h = 0; h < count; ++h) {
        if (net_.is_alive(h) && net_.edge_length(h) > longest) {
            net_.split(h, project_(0.5 * (net_.positions[net_.from(h)] + net_.positions[net_.to(h)])));
        }
    }
}

/// True if moving from(h) to to(h) would make a long edge or turn a triangle by more than 60 degrees.
bool Remesher::collapse_folds(uint32_t h, double longest) const {
    const uint32_t b = net_.to(h);
    const Vec3& target = net_.positions[b];
    bool folds = false;
    net_.around(net_.from(h), [&](uint32_t out) {
        const uint32_t c = net_.to(out);
        const uint32_t d = net_.apex(out);
        if (c == b || d == b || folds) {
            return;
        }
        const Vec3 before = net_.face_normal(out);
        const Vec3 after = glm::cross(net_.positions[c] - target, net_.positions[d] - target);
        folds = glm::distance(target, net_.positions[c]) > longest ||
                !(glm::dot(before, after) > 0.5 * glm::length(before) * glm::length(after));
    });
    return folds;
}

void Remesher::collapse_short(double shortest, double longest) {
    const uint32_t count = net_.half_edge_count();
    for (uint32_t h = 0; h < count; ++h) {
        if (net_.is_alive(h) && net_.edge_length(h) < shortest && net_.can_collapse(h) &&
            !collapse_folds(h, longest)) {
            net_.collapse(h);
        }
    }
}

/// How much nearer to 6 the four valences come, as a drop of their squared deviations.
int Remesher::valence_gain(uint32_t h) const {
    const auto cost = [&](uint32_t v, int change) {
        const int off = static_cast<int>(net_.degree(v)) + change - 6;
        return off * off;
    };
    const uint32_t a = net_.from(h);
    const uint32_t b = net_.to(h);
    const uint32_t c = net_.apex(h);
    const uint32_t d = net_.apex(net_.twin(h));
    return cost(a, 0) + cost(b, 0) + cost(c, 0) + cost(d, 0) - cost(a, -1) - cost(b, -1) - cost(c, 1) -
           cost(d, 1);
}

/// True if flipping would turn a triangle away from the two that are there, worse than they are turned
/// already.
bool Remesher::flip_folds(uint32_t h) const {
    const uint32_t g = net_.twin(h);
    const auto& p = net_.positions;
    const Vec3 a = p[net_.from(h)];
    const Vec3 b = p[net_.to(h)];
    const Vec3 c = p[net_.apex(h)];
    const Vec3 d = p[net_.apex(g)];
    const Vec3 mean = glm::cross(c - d, a - b);
    return std::min(cosine(mean, glm::cross(d - c, b - c)), cosine(mean, glm::cross(c - d, a - d))) <
           std::min({most_turned, cosine(mean, net_.face_normal(h)), cosine(mean, net_.face_normal(g))});
}

void Remesher::flip_edges() {
    for (uint32_t h = 0; h < net_.half_edge_count(); ++h) {
        if (net_.is_alive(h) && h < net_.twin(h) && valence_gain(h) > 0 && net_.can_flip(h) &&
            !flip_folds(h)) {
            net_.flip(h);
        }
    }
}

/// The mean of the surrounding triangles' centres, weighted by their areas, without what leaves the tangent
/// plane.
Vec3 Remesher::smoothed(uint32_t v) const {
    const Vec3& p = net_.positions[v];
    Vec3 normal(0);
    Vec3 pull(0);
    double weight = 0;
    net_.around(v, [&](uint32_t h) {
        const Vec3 face = net_.face_normal(h);
        const double area = glm::length(face);
        normal += face;
        pull += area * ((net_.positions[net_.to(h)] + net_.positions[net_.apex(h)] - 2.0 * p) / 3.0);
        weight += area;
    });
    const double length2 = glm::dot(normal, normal);
    if (!(weight > 0) || !(length2 > 0)) {
        return p;
    }
    pull /= weight;
    return project_(p + pull - glm::dot(pull, normal) / length2 * normal);
}

/// True if moving v would turn a triangle at it away from their mean, worse than one is turned already.
bool Remesher::move_folds(uint32_t v, const Vec3& p) const {
    Vec3 mean(0);
    net_.around(v, [&](uint32_t h) { mean += net_.face_normal(h); });
    double before = most_turned;
    double after = is_finite(p) ? 1 : -1;
    net_.around(v, [&](uint32_t h) {
        before = std::min(before, cosine(mean, net_.face_normal(h)));
        after = std::min(after, cosine(mean, glm::cross(net_.positions[net_.to(h)] - p,
                                                        net_.positions[net_.apex(h)] - p)));
    });
    return after < before;
}

void Remesher::smooth() {
    std::vector<Vec3> moved(net_.positions);
    parallel_for(net_.vertex_slots(), grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto v = static_cast<uint32_t>(i);
            if (net_.has_vertex(v)) {
                const Vec3 p = smoothed(v);
                moved[v] = move_folds(v, p) ? net_.positions[v] : p;
            }
        }
    });
    net_.positions = std::move(moved);
}

/// Sine of a triangle's least angle.
double Remesher::least_sine(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const double ab = glm::distance(a, b);
    const double bc = glm::distance(b, c);
    const double ca = glm::distance(c, a);
    // The least angle lies between the two longer edges.
    const double product = ab * bc * ca / std::min({ab, bc, ca});
    return product > 0 ? glm::length(glm::cross(b - a, c - a)) / product : 0;
}

double Remesher::least_sine(uint32_t h) const {
    return least_sine(net_.positions[net_.from(h)], net_.positions[net_.to(h)], net_.positions[net_.apex(h)]);
}

/// Flips the thin face's longest edge if that widens both triangles, else collapses its shortest.
bool Remesher::mend_face(uint32_t h) {
    std::array<uint32_t, 3> edges{h, h + 1, h + 2};
    std::sort(edges.begin(), edges.end(),
              [&](uint32_t a, uint32_t b) { return net_.edge_length(a) > net_.edge_length(b); });
    const uint32_t longest = edges[0];
    const auto& p = net_.positions;
    const Vec3& c = p[net_.apex(longest)];
    const Vec3& d = p[net_.apex(net_.twin(longest))];
    const double before = std::min(least_sine(h), least_sine(net_.twin(longest)));
    const double after =
        std::min(least_sine(c, d, p[net_.to(longest)]), least_sine(d, c, p[net_.from(longest)]));
    if (after > before && net_.can_flip(longest) && !flip_folds(longest)) {
        net_.flip(longest);
        return true;
    }
    const uint32_t shortest = edges[2];
    for (const uint32_t edge : {shortest, net_.twin(shortest)}) {
        if (net_.can_collapse(edge) && !collapse_folds(edge, 1.2 * net_.edge_length(longest))) {
            net_.collapse(edge);
            return true;
        }
    }
    return false;
}

/// Takes out the few triangles that are still thin, as quartering a fold of the surface leaves them.
void Remesher::mend() {
    for (int pass = 0; pass < 12; ++pass) {
        size_t mended = 0;
        for (uint32_t h = 0; h < net_.half_edge_count(); h += 3) {
            mended += net_.is_alive(h) && least_sine(h) < thin && mend_face(h);
        }
        if (mended == 0) {
            break;
        }
        smooth();
    }
}

} // namespace

Projection projection_onto(ScalarField f, double step) {
    return [f = std::move(f), step](const Vec3& start) {
        Vec3 p = start;
        double value = f(p);
        for (int i = 0; i < 8 && std::abs(value) > 1e-10 * step; ++i) {
            Vec3 gradient;
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 offset(0);
                offset[axis] = step;
                gradient[axis] = (f(p + offset) - f(p - offset)) / (2 * step);
            }
            const double slope2 = glm::dot(gradient, gradient);
            const Vec3 next = p - value / slope2 * gradient;
            const double next_value = f(next);
            if (!(std::abs(next_value) < std::abs(value))) {
                break;
            }
            p = next;
            value = next_value;
        }
        return p;
    };
}

Mesh remesh(const Mesh& mesh, const Projection& project, const RemeshOptions& options) {
    if (!(options.edge_length > 0)) {
        throw InputError("remeshing needs a positive edge length");
    }
    Remesher remesher(mesh, project);
    remesher.run(options.edge_length, options.rounds);
    return remesher.net().to_mesh();
}

Mesh remesh_to_count(const Mesh& mesh, const Projection& project, size_t vertices) {
    size_t base = vertices;
    int quarterings = 0;
    for (; base > most_remeshed; ++quarterings) {
        base = base / 4 + 1; // a closed surface of genus 0 goes from V to 4 V - 6
    }
    Remesher remesher(mesh, project);
    const double wish = static_cast<double>(base);
    double edge = std::sqrt(2 * remesher.area() / (std::sqrt(3.0) * wish));
    for (int attempt = 0; attempt < 8; ++attempt) {
        remesher.run(edge, attempt == 0 ? 6 : 3);
        const double ratio = static_cast<double>(remesher.net().vertex_count()) / wish;
        if (std::abs(ratio - 1) < 0.03) {
            break;
        }
        edge *= std::sqrt(ratio);
    }
    for (int q = 0; q < quarterings; ++q) {
        remesher.quarter();
    }
    return remesher.net().to_mesh();
}

} // namespace anvil
