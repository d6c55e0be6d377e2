// Ends what the window no longer shows, beside the window.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace anvil {

/// To free a surface of a million triangles, with the tree that picks on it, takes a tenth of a second.
class Disposer {
  public:
    Disposer();
    /// Ends all that was given.
    ~Disposer();
    Disposer(const Disposer&) = delete;
    Disposer& operator=(const Disposer&) = delete;

    /// Ends it on a thread of its own, if nobody else holds it. The caller lets go of it, wherever it has it.
    template <class T>
    void take(std::shared_ptr<T> thing) {
        add(std::shared_ptr<const void>(std::move(thing)));
    }
    template <class T>
    void take_value(T&& value) {
        add(std::make_shared<const std::decay_t<T>>(std::forward<T>(value)));
    }

  private:
    void add(std::shared_ptr<const void> thing);
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<std::shared_ptr<const void>> things_;
    bool stopping_ = false;
    std::thread thread_; ///< last: all else is there when it begins
};

} // namespace anvil
