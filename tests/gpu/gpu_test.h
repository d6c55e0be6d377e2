// What the GPU tests share. Without a Vulkan device they fail: a skipped GPU test proves nothing.
#pragma once

#include "engine/gpu/device.h"

#include <catch2/catch.hpp>
#include <memory>

/// A device under the validation layer (synchronization included); its destructor fails the test on any
/// message.
class CheckedDevice {
  public:
    CheckedDevice() : device_(std::make_shared<anvil::Device>(anvil::DeviceOptions{.validation = true})) {}
    ~CheckedDevice() {
        for (const std::string& message : device_->take_validation_messages()) {
            FAIL_CHECK(message);
        }
    }
    CheckedDevice(const CheckedDevice&) = delete;
    CheckedDevice& operator=(const CheckedDevice&) = delete;

    const std::shared_ptr<anvil::Device>& shared() const { return device_; }
    anvil::Device& operator*() const { return *device_; }
    anvil::Device* operator->() const { return device_.get(); }

  private:
    std::shared_ptr<anvil::Device> device_;
};
