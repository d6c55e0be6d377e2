// A front ordered roughly by distance: no heap, no memory taken once it has grown.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace anvil {

/// Items in buckets of equal width over a key that grows; within a bucket first in, first out. Keys that lie
/// behind the bucket being emptied go into it.
template <typename Item>
class BucketQueue {
  public:
    /// `reach`: how far beyond the bucket in hand a key may lie. The ring has a bounded number of buckets, so
    /// a very small width is made larger.
    BucketQueue(double width, double reach) {
        width_ = std::max(width, reach / most_buckets);
        // Anything smaller has no inverse.
        if (!(width_ > 1e-300)) {
            width_ = 1;
        }
        inverse_width_ = 1 / width_;
        const auto wanted = static_cast<size_t>(reach / width_) + 4;
        buckets_.resize(std::bit_ceil(wanted));
    }

    /// Empties the queue and starts at key 0; nothing is held back.
    void clear() {
        // Emptied buckets are cleared as they are left, so only the one in hand can hold anything when none
        // live.
        buckets_[current_ & (buckets_.size() - 1)].clear();
        for (size_t i = 0; live_ > 0 && i < buckets_.size(); ++i) {
            buckets_[i].clear();
        }
        held_back_.clear();
        live_ = 0;
        last_ = 0;
        rewind();
    }

    /// Back to key 0, for items that come before those already taken. The queue is empty.
    void rewind() {
        buckets_[current_ & (buckets_.size() - 1)].clear();
        current_ = 0;
        place_ = 0;
    }

    /// Items beyond the bucket of `key` are held back, whole buckets at a time, until a later call lets them
    /// in.
    void open_until(double key) {
        last_ = bucket_of(key);
        std::vector<Held> held;
        held.swap(held_back_);
        for (const Held& h : held) {
            push(h.key, h.item);
        }
    }

    size_t bucket_of(double key) const {
        return key < 1e18 * width_ ? static_cast<size_t>(key * inverse_width_) : static_cast<size_t>(1e18);
    }
    size_t current() const { return current_; }
    double width() const { return width_; }
    bool empty() const { return live_ == 0; }

    // Inlined, an item is written where it stays; copied from where it was just put together it stalls.
    [[gnu::always_inline]] void push(double key, const Item& item) {
        const size_t bucket = bucket_of(key);
        if (bucket > last_) {
            held_back_.push_back({key, item});
            return;
        }
        const size_t place = std::clamp(bucket, current_, current_ + buckets_.size() - 1);
        buckets_[place & (buckets_.size() - 1)].push_back(item);
        ++live_;
    }

    /// Not empty.
    Item pop() {
        while (true) {
            std::vector<Item>& bucket = buckets_[current_ & (buckets_.size() - 1)];
            if (place_ < bucket.size()) {
                --live_;
                return bucket[place_++];
            }
            bucket.clear();
            place_ = 0;
            ++current_;
        }
    }

    /// The item that will be taken after `further` others, if it waits in the bucket being emptied and
    /// nothing comes between; else null.
    const Item* ahead(size_t further) const {
        const std::vector<Item>& bucket = buckets_[current_ & (buckets_.size() - 1)];
        return place_ + further < bucket.size() ? &bucket[place_ + further] : nullptr;
    }

  private:
    struct Held {
        double key;
        Item item;
    };
    static constexpr size_t most_buckets = 1 << 16;
    double width_ = 1, inverse_width_ = 1;
    std::vector<std::vector<Item>> buckets_;
    std::vector<Held> held_back_;
    size_t last_ = 0;
    size_t current_ = 0;
    size_t place_ = 0;
    size_t live_ = 0;
};

} // namespace anvil
