// What is wrong with a mesh, found beside the window.
#pragma once

#include "engine/mesh/health.h"

#include <functional>
#include <future>
#include <memory>
#include <vector>

namespace anvil {

class HealthCheck {
  public:
    /// `done` is called, from another thread, when there is a result.
    explicit HealthCheck(std::function<void()> done) : done_(std::move(done)) {}

    /// Another mesh; the result of the one before is no more.
    void start(std::shared_ptr<const Mesh> mesh);
    /// Of the mesh that was given last; nullptr: not yet. Holds until start().
    const MeshHealth* result();

  private:
    std::function<void()> done_;
    std::vector<std::future<MeshHealth>> running_; ///< the last one counts, the others are only waited for
    std::unique_ptr<const MeshHealth> result_;
};

/// A finding as a person reads it, and what can be done about it.
struct HealthAdvice {
    std::string finding;
    std::string mend;
};

/// All that can spoil an edit, the worst first; empty: the mesh is sound.
std::vector<HealthAdvice> advice_on(const MeshHealth& health);

} // namespace anvil
