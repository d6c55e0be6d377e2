// The window: GLFW, and nothing else of the program knows it.
#pragma once

#include "app/viewer/input_event.h"

#include <functional>
#include <string>
#include <vector>

struct GLFWwindow;
struct VkInstance_T;
struct VkSurfaceKHR_T;

namespace anvil {

struct WindowSize {
    int width = 0;
    int height = 0;

    bool operator==(const WindowSize&) const = default;
    bool empty() const { return width <= 0 || height <= 0; }
};

/// The connection to the screen; outlives all windows on it. One at a time.
class Display {
  public:
    /// @throws DeviceError if there is no display or it has no Vulkan.
    Display();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
};

class Window {
  public:
    /// @throws DeviceError
    Window(const Display& display, WindowSize size, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions that a surface for this window wants.
    static std::vector<std::string> instance_extensions();
    /// The caller destroys it. @throws DeviceError
    VkSurfaceKHR_T* make_surface(VkInstance_T* instance) const;

    /// All events since the last call; waits up to `seconds` for one if there is none (0: does not wait).
    std::vector<InputEvent> take_events(double seconds);
    /// Ends another thread's take_events().
    static void wake();

    WindowSize framebuffer_size() const; ///< pixels; empty while minimized
    double scale() const;                ///< of the display: 1 at 96 dots an inch
    void resize(WindowSize size);
    /// Or shows it again. Where no window manager does it, it is at least as if.
    void minimize(bool away);
    void set_title(const std::string& title);
    std::string clipboard() const;
    void set_clipboard(const std::string& text);

  private:
    struct Callbacks;
    GLFWwindow* window_ = nullptr;
    std::vector<InputEvent> events_;
    Modifiers modifiers_;
    bool away_ = false; ///< minimize() says so
};

/// A key's number by its name in scripts and help: "a", "F5", "escape", "left"; 0 if there is none.
int key_of(const std::string& name);

} // namespace anvil
