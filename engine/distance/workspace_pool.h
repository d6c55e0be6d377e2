// Workspaces for calls from any number of threads.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace anvil {

/// Keeps what calls give back; as many workspaces exist as calls ever ran at once.
template <typename Workspace>
class WorkspacePool {
  public:
    /// A kept workspace, or a new one from make(). It must be given back; dropping it frees it.
    template <typename Make>
    std::unique_ptr<Workspace> borrow(const Make& make) {
        {
            const std::scoped_lock lock(mutex_);
            if (!idle_.empty()) {
                std::unique_ptr<Workspace> kept = std::move(idle_.back());
                idle_.pop_back();
                return kept;
            }
        }
        return std::make_unique<Workspace>(make());
    }

    void give_back(std::unique_ptr<Workspace> workspace) {
        const std::scoped_lock lock(mutex_);
        idle_.push_back(std::move(workspace));
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workspace>> idle_;
};

} // namespace anvil
