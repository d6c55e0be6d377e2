#include "app/viewer/ui.h"

#include <GLFW/glfw3.h>
#include <array>
#include <filesystem>
#include <imgui.h>
#include <utility>

namespace anvil {

namespace {

constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_pixels = 14;

const char* get_clipboard(void* window) {
    static std::string text; // ImGui reads it at once
    text = static_cast<Window*>(window)->clipboard();
    return text.c_str();
}

void set_clipboard(void* window, const char* text) {
    static_cast<Window*>(window)->set_clipboard(text);
}

void map_keys(ImGuiIO& io) {
    constexpr std::array<std::pair<ImGuiKey_, int>, 21> keys{{{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                              {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                              {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                              {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                              {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                              {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                                              {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                                              {ImGuiKey_Home, GLFW_KEY_HOME},
                                                              {ImGuiKey_End, GLFW_KEY_END},
                                                              {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                              {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                              {ImGuiKey_Space, GLFW_KEY_SPACE},
                                                              {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                              {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                              {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                              {ImGuiKey_A, GLFW_KEY_A},
                                                              {ImGuiKey_C, GLFW_KEY_C},
                                                              {ImGuiKey_V, GLFW_KEY_V},
                                                              {ImGuiKey_X, GLFW_KEY_X},
                                                              {ImGuiKey_Y, GLFW_KEY_Y},
                                                              {ImGuiKey_Z, GLFW_KEY_Z}}};
    for (const auto& [imgui, glfw] : keys) {
        io.KeyMap[imgui] = glfw;
    }
}

void set_style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.13F, 0.135F, 0.15F, 0.94F);
    style.Colors[ImGuiCol_MenuBarBg] = ImVec4(0.10F, 0.105F, 0.12F, 1);
    style.ScaleAllSizes(scale);
}

/// A text field, or a question that is asked: what answers it is no command to what lies behind.
bool takes_keys() {
    return ImGui::GetIO().WantTextInput ||
           ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

} // namespace

Ui::Ui(Window& window, double scale) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // panels have their places; nothing is written to the working folder
    io.GetClipboardTextFn = get_clipboard;
    io.SetClipboardTextFn = set_clipboard;
    io.ClipboardUserData = &window;
    map_keys(io);
    const auto size = static_cast<float>(scale);
    std::error_code error;
    if (std::filesystem::exists(font_file, error)) {
        // Names of files have letters of other languages too. 0 ends it.
        static constexpr std::array<ImWchar, 9> letters{0x20,   0x24F,  0x370,  0x52F, 0x1E00,
                                                        0x1FFF, 0x2010, 0x205E, 0};
        io.Fonts->AddFontFromFileTTF(font_file, font_pixels * size, nullptr, letters.data());
    } else {
        ImFontConfig config;
        config.SizePixels = 13 * size;
        io.Fonts->AddFontDefault(&config);
    }
    set_style(size);
}

Ui::~Ui() {
    ImGui::DestroyContext();
}

bool Ui::handle(const InputEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyShift = event.modifiers.shift;
    io.KeyCtrl = event.modifiers.control;
    io.KeyAlt = event.modifiers.alt;
    switch (event.kind) {
    case InputEvent::Kind::move:
        io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
        return io.WantCaptureMouse;
    case InputEvent::Kind::press:
    case InputEvent::Kind::release:
        io.MouseDown[static_cast<size_t>(event.button)] = event.kind == InputEvent::Kind::press;
        return io.WantCaptureMouse;
    case InputEvent::Kind::scroll:
        if (io.WantCaptureMouse) {
            io.MouseWheel += static_cast<float>(event.y);
            io.MouseWheelH += static_cast<float>(event.x);
        }
        return io.WantCaptureMouse;
    case InputEvent::Kind::key_down:
    case InputEvent::Kind::key_up:
        if (event.key >= 0 && event.key < 512) {
            io.KeysDown[event.key] = event.kind == InputEvent::Kind::key_down;
        }
        return takes_keys();
    case InputEvent::Kind::text:
        if (io.WantTextInput) {
            io.AddInputCharacter(event.character);
        }
        return takes_keys();
    default:
        return false;
    }
}

void Ui::begin_frame(WindowSize size, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.width), static_cast<float>(size.height));
    io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
    ImGui::NewFrame();
}

bool Ui::active() {
    return ImGui::IsAnyItemActive() || ImGui::GetIO().WantTextInput;
}

} // namespace anvil
