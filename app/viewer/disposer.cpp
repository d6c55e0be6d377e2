#include "app/viewer/disposer.h"

namespace anvil {

Disposer::Disposer() : thread_([this] { run(); }) {}

Disposer::~Disposer() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void Disposer::add(std::shared_ptr<const void> thing) {
    if (!thing) {
        return;
    }
    {
        const std::lock_guard lock(mutex_);
        things_.push_back(std::move(thing));
    }
    wake_.notify_one();
}

void Disposer::run() {
    bool stopping = false;
    while (!stopping) {
        std::vector<std::shared_ptr<const void>> ended;
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return stopping_ || !things_.empty(); });
        stopping = stopping_;
        ended.swap(things_);
        lock.unlock();
    }
}

} // namespace anvil
