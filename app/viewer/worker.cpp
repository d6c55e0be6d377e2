#include "app/viewer/worker.h"

#include <chrono>

namespace anvil {

Worker::Worker(std::function<void(std::exception_ptr)> failed, std::function<void()> changed)
    : failed_(std::move(failed)), changed_(std::move(changed)), thread_([this] { run(); }) {}

Worker::~Worker() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        waiting_.clear();
        if (progress_) {
            progress_->cancel();
        }
    }
    wake_.notify_all();
    thread_.join();
}

void Worker::add(const std::string& what, Job job, const std::string& replaces) {
    {
        const std::lock_guard lock(mutex_);
        if (!replaces.empty() && !waiting_.empty() && waiting_.back().key == replaces) {
            waiting_.pop_back();
        }
        waiting_.push_back({what, replaces, std::move(job)});
    }
    wake_.notify_all();
}

void Worker::cancel() {
    const std::lock_guard lock(mutex_);
    if (progress_) {
        progress_->cancel();
    }
}

void Worker::cancel(const std::string& what) {
    const std::lock_guard lock(mutex_);
    if (progress_ && state_.job == what) {
        progress_->cancel();
    }
}

bool Worker::idle() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty() && !progress_;
}

WorkerState Worker::state() const {
    const std::lock_guard lock(mutex_);
    WorkerState state = state_;
    if (progress_) {
        state.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    }
    return state;
}

void Worker::run() {
    while (true) {
        Waiting next;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
            if (stopping_) {
                return;
            }
            next = std::move(waiting_.front());
            waiting_.pop_front();
            progress_ = std::make_shared<Progress>([this](const std::string& stage, double fraction) {
                const std::lock_guard report(mutex_);
                state_.stage = stage;
                state_.fraction = fraction;
            });
            state_ = {next.what, "", 0, 0};
            begun_ = std::chrono::steady_clock::now();
        }
        perform(next);
        {
            const std::lock_guard lock(mutex_);
            progress_.reset();
            state_ = {};
        }
        changed_();
    }
}

void Worker::perform(Waiting& next) {
    try {
        next.job(*progress_);
    } catch (...) {
        failed_(std::current_exception());
    }
    next.job = nullptr; // what it holds goes before the next begins
}

} // namespace anvil
