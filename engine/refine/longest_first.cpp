#include "engine/refine/longest_first.h"

namespace anvil {

namespace {

class LongestFirst {
  public:
    LongestFirst(const EdgeMesh& mesh, std::span<const Vec3> positions, double thinnest,
                 const std::vector<char>& fixed, std::vector<EdgeSplit>& splits)
        : mesh_(mesh), positions_(positions), thinnest_(thinnest), fixed_(fixed), splits_(splits),
          made_before_(splits.size()), split_of_(mesh.edges().size(), no_index) {
        for (uint32_t i = 0; i < splits.size(); ++i) {
            split_of_[splits[i].edge] = i;
        }
        fate_.assign(splits.size(), Fate::made);
    }

    GivenWay run(std::span<const uint32_t> candidates) {
        for (const uint32_t face : candidates) {
            look_at(mesh_.faces()[face]);
        }
        // What gives way may do so to an edge of any face.
        for (size_t known = 0; splits_.size() > made_before_ + known;) {
            known = splits_.size() - made_before_;
            for (const EdgeMesh::Face& face : mesh_.faces()) {
                look_at(face);
            }
        }
        GivenWay result;
        size_t kept = 0;
        for (size_t i = 0; i < splits_.size(); ++i) {
            if (fate_[i] == Fate::gives_way) {
                result.later.push_back(splits_[i].edge);
            } else if (fate_[i] == Fate::blocked) {
                result.blocked.push_back(splits_[i].edge);
            } else {
                splits_[kept++] = splits_[i];
            }
        }
        splits_.resize(kept);
        return result;
    }

  private:
    enum class Fate : char { made, gives_way, blocked };

    bool is_split(uint32_t edge) const { return edge != no_index && split_of_[edge] != no_index; }

    double length_of(uint32_t edge) const {
        if (edge == no_index) {
            return 0;
        }
        const EdgeMesh::Edge& e = mesh_.edges()[edge];
        return glm::distance(positions_[e.a], positions_[e.b]);
    }

    void look_at(const EdgeMesh::Face& face) {
        if (!is_split(face.edges[0]) && !is_split(face.edges[1]) && !is_split(face.edges[2])) {
            return;
        }
        const Vec3 lengths(length_of(face.edges[0]), length_of(face.edges[1]), length_of(face.edges[2]));
        int longest = lengths[1] > lengths[0] ? 1 : 0;
        longest = lengths[2] > lengths[longest] ? 2 : longest;
        const auto& [a, b, c] = face.corners;
        const double twice_area =
            glm::length(glm::cross(positions_[b] - positions_[a], positions_[c] - positions_[a]));
        if (twice_area >= thinnest_ * lengths[longest] * lengths[longest]) {
            return;
        }
        for (int i = 0; i < 3; ++i) {
            if (i != longest && is_split(face.edges[i])) {
                give_way(split_of_[face.edges[i]], face.edges[longest]);
            }
        }
    }

    void give_way(uint32_t split, uint32_t longest) {
        if (splits_[split].crease != no_index) {
            return;
        }
        if (fixed_[longest]) {
            fate_[split] = Fate::blocked;
            return;
        }
        fate_[split] = Fate::gives_way;
        if (!is_split(longest)) {
            split_of_[longest] = static_cast<uint32_t>(splits_.size());
            splits_.push_back({longest, 0.5, splits_[split].error, no_index});
            fate_.push_back(Fate::made);
        }
    }

    const EdgeMesh& mesh_;
    std::span<const Vec3> positions_;
    double thinnest_;
    const std::vector<char>& fixed_;
    std::vector<EdgeSplit>& splits_;
    size_t made_before_;             ///< splits that were asked for
    std::vector<uint32_t> split_of_; ///< per edge: index into the splits
    std::vector<Fate> fate_;         ///< per split
};

} // namespace

GivenWay put_longest_first(const EdgeMesh& mesh, std::span<const uint32_t> candidates,
                           std::span<const Vec3> positions, double thinnest, const std::vector<char>& fixed,
                           std::vector<EdgeSplit>& splits) {
    return splits.empty() ? GivenWay{}
                          : LongestFirst(mesh, positions, thinnest, fixed, splits).run(candidates);
}

} // namespace anvil
