#include "app/viewer/window.h"

#include "engine/core/error.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

// GLFW declares this only where Vulkan's own header comes first, which is confined to engine/gpu/vulkan.h.
extern "C" int glfwCreateWindowSurface(VkInstance_T* instance, GLFWwindow* window, const void* allocator,
                                       VkSurfaceKHR_T** surface);

namespace anvil {

namespace {

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

Modifiers modifiers_of(int mods) {
    return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

} // namespace

struct Window::Callbacks {
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

    static InputEvent& add(GLFWwindow* window, InputEvent::Kind kind) {
        Window& self = of(window);
        InputEvent event;
        event.kind = kind;
        event.modifiers = self.modifiers_;
        self.events_.push_back(std::move(event));
        return self.events_.back();
    }

    static void move(GLFWwindow* window, double x, double y) {
        int wide = 1;
        int pixels = 1;
        int unused = 0;
        glfwGetWindowSize(window, &wide, &unused);
        glfwGetFramebufferSize(window, &pixels, &unused);
        const double scale = wide > 0 ? static_cast<double>(pixels) / wide : 1.0;
        InputEvent& event = add(window, InputEvent::Kind::move);
        event.x = x * scale;
        event.y = y * scale;
    }

    static void button(GLFWwindow* window, int number, int action, int mods) {
        if (number > GLFW_MOUSE_BUTTON_MIDDLE) {
            return;
        }
        of(window).modifiers_ = modifiers_of(mods);
        InputEvent& event =
            add(window, action == GLFW_PRESS ? InputEvent::Kind::press : InputEvent::Kind::release);
        event.button = static_cast<MouseButton>(number); // left, right, middle: GLFW's order
    }

    static void scroll(GLFWwindow* window, double x, double y) {
        InputEvent& event = add(window, InputEvent::Kind::scroll);
        event.x = x;
        event.y = y;
    }

    static void key(GLFWwindow* window, int number, int /*scancode*/, int action, int mods) {
        of(window).modifiers_ = modifiers_of(mods);
        // The key's letter on this keyboard, not its place on an American one.
        const char* name = number >= GLFW_KEY_A && number <= GLFW_KEY_Z ? glfwGetKeyName(number, 0) : nullptr;
        if (name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0') {
            number = GLFW_KEY_A + (name[0] - 'a');
        }
        add(window, action == GLFW_RELEASE ? InputEvent::Kind::key_up : InputEvent::Kind::key_down).key =
            number;
    }

    static void text(GLFWwindow* window, unsigned int character) {
        add(window, InputEvent::Kind::text).character = character;
    }

    static void drop(GLFWwindow* window, int count, const char** paths) {
        add(window, InputEvent::Kind::drop).files.assign(paths, paths + count);
    }

    static void close(GLFWwindow* window) {
        glfwSetWindowShouldClose(window, GLFW_FALSE); // unsaved changes are asked for first
        add(window, InputEvent::Kind::close);
    }
};

Display::Display() {
    if (glfwInit() != GLFW_TRUE) {
        throw DeviceError(
            "no window can be opened (" + last_glfw_error() +
            "); is there a display? `anvil forge` works without one, and so does `xvfb-run anvil view`");
    }
    if (glfwVulkanSupported() != GLFW_TRUE) {
        glfwTerminate();
        throw DeviceError("there is no Vulkan loader or driver on this machine (Debian: libvulkan1 and "
                          "mesa-vulkan-drivers); the viewer draws with Vulkan");
    }
}

Display::~Display() {
    glfwTerminate();
}

Window::Window(const Display& /*display*/, WindowSize size, const std::string& title) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        throw DeviceError("no window can be opened (" + last_glfw_error() + ")");
    }
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, Callbacks::move);
    glfwSetMouseButtonCallback(window_, Callbacks::button);
    glfwSetScrollCallback(window_, Callbacks::scroll);
    glfwSetKeyCallback(window_, Callbacks::key);
    glfwSetCharCallback(window_, Callbacks::text);
    glfwSetDropCallback(window_, Callbacks::drop);
    glfwSetWindowCloseCallback(window_, Callbacks::close);
}

Window::~Window() {
    glfwDestroyWindow(window_);
}

std::vector<std::string> Window::instance_extensions() {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

VkSurfaceKHR_T* Window::make_surface(VkInstance_T* instance) const {
    VkSurfaceKHR_T* surface = nullptr;
    if (glfwCreateWindowSurface(instance, window_, nullptr, &surface) != 0) {
        throw DeviceError("the window cannot be drawn to by Vulkan (" + last_glfw_error() + ")");
    }
    return surface;
}

std::vector<InputEvent> Window::take_events(double seconds) {
    if (seconds > 0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return std::exchange(events_, {});
}

void Window::wake() {
    glfwPostEmptyEvent();
}

WindowSize Window::framebuffer_size() const {
    WindowSize size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return away_ || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE ? WindowSize{} : size;
}

double Window::scale() const {
    float x = 1;
    float y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0 ? x : 1;
}

void Window::resize(WindowSize size) {
    glfwSetWindowSize(window_, size.width, size.height);
}

void Window::minimize(bool away) {
    away_ = away;
    away ? glfwIconifyWindow(window_) : glfwRestoreWindow(window_);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(window_);
    return text != nullptr ? text : "";
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

int key_of(const std::string& name) {
    static const std::array<std::pair<const char*, int>, 21> named{
        {{"escape", GLFW_KEY_ESCAPE},    {"enter", GLFW_KEY_ENTER},
         {"tab", GLFW_KEY_TAB},          {"backspace", GLFW_KEY_BACKSPACE},
         {"delete", GLFW_KEY_DELETE},    {"left", GLFW_KEY_LEFT},
         {"right", GLFW_KEY_RIGHT},      {"up", GLFW_KEY_UP},
         {"down", GLFW_KEY_DOWN},        {"home", GLFW_KEY_HOME},
         {"end", GLFW_KEY_END},          {"space", GLFW_KEY_SPACE},
         {"shift", GLFW_KEY_LEFT_SHIFT}, {"ctrl", GLFW_KEY_LEFT_CONTROL},
         {"alt", GLFW_KEY_LEFT_ALT},     {"minus", GLFW_KEY_MINUS},
         {"period", GLFW_KEY_PERIOD},    {"comma", GLFW_KEY_COMMA},
         {"plus", GLFW_KEY_KP_ADD},      {"slash", GLFW_KEY_SLASH},
         {"equal", GLFW_KEY_EQUAL}}};
    if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])) != 0) {
        return std::toupper(static_cast<unsigned char>(name[0]));
    }
    if (name.size() >= 2 && name.size() <= 3 && name[0] == 'F') {
        const int number = std::atoi(name.c_str() + 1);
        return number >= 1 && number <= 12 ? GLFW_KEY_F1 + number - 1 : 0;
    }
    const auto* found =
        std::find_if(named.begin(), named.end(), [&](const auto& entry) { return name == entry.first; });
    return found != named.end() ? found->second : 0;
}

} // namespace anvil
