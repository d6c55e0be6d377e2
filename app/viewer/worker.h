// Long work beside the window: one thread, jobs in order.
#pragma once

#include "engine/core/progress.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace anvil {

/// What the thread is at.
struct WorkerState {
    std::string job; ///< what a person reads; empty: nothing
    std::string stage;
    double fraction = 0;
    double seconds = 0; ///< since the job began
};

class Worker {
  public:
    using Job = std::function<void(Progress&)>;

    /// `failed` hears, on the thread, what a job threw; `changed` that a job ended or got on.
    Worker(std::function<void(std::exception_ptr)> failed, std::function<void()> changed);
    /// Cancels the job under way and forgets the rest.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// After all jobs so far. `replaces`, if not empty: a job of that name that waits to begin, as the last
    /// of all, does not any more: of a drag's places only the last counts.
    void add(const std::string& what, Job job, const std::string& replaces = "");
    void cancel();                        ///< the job under way; the others go on
    void cancel(const std::string& what); ///< the same if that is what it is
    bool idle() const;
    WorkerState state() const;

  private:
    struct Waiting {
        std::string what;
        std::string key;
        Job job;
    };

    void run();
    void perform(Waiting& next);

    std::function<void(std::exception_ptr)> failed_;
    std::function<void()> changed_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Waiting> waiting_;
    std::shared_ptr<Progress> progress_; ///< of the job under way
    WorkerState state_;
    std::chrono::steady_clock::time_point begun_;
    bool stopping_ = false;
    std::thread thread_; ///< last: all else is there when it begins
};

} // namespace anvil
