#include "app/viewer/viewer.h"

#include "app/backend_choice.h"
#include "app/viewer/event_queue.h"
#include "app/viewer/painter.h"
#include "app/viewer/panels/overlay.h"
#include "app/viewer/panels/panels.h"
#include "app/viewer/script_player.h"
#include "app/viewer/session.h"
#include "app/viewer/ui.h"
#include "engine/core/error.h"

#include <chrono>
#include <imgui.h>

namespace anvil {

namespace {

using Clock = std::chrono::steady_clock;

constexpr WindowSize first_size{1280, 800};
constexpr double idle_wait = 0.5;     // seconds; panels blink no faster
constexpr double rest_before = 0.25;  // seconds without a change before a frame is drawn finely
constexpr double work_wait = 0.04;    // seconds; progress is shown that often
constexpr double script_wait = 0.005; // seconds
constexpr int most_losses = 3;        // of the device that draws, in one run
constexpr int frames_after_event = 3; // panels answer an event a frame or two later

std::shared_ptr<Device> open_device() {
    DeviceOptions options;
    options.instance_extensions = Window::instance_extensions();
    options.device_extensions = {"VK_KHR_swapchain"};
    return std::make_shared<Device>(options);
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_shortcut(const InputEvent& event, const char* key) {
    return event.kind == InputEvent::Kind::key_down && event.modifiers.control && event.key == key_of(key);
}

class Viewer {
  public:
    /// `player`: nullptr: a person is there; it and `lost`, what is taken over, outlive this.
    Viewer(const Display& display, const ViewerOptions& options, ScriptPlayer* player,
           const std::shared_ptr<LostSession>& lost)
        : options_(options), window_(display, first_size, "Anvil"), device_(open_device()),
          ui_(window_, window_.scale()), painter_(*device_, window_, disposer_),
          session_(device_, {options.device, device_baking(options.bake)}, disposer_,
                   [] { Window::wake(); }) {
        session_.view.less_in_motion = painter_.draws_on_cpu();
        session_.camera.unit = window_.scale();
        player_ = player;
        if (lost) {
            session_.recover(lost);
        } else if (!options.file.empty()) {
            session_.open(options.file);
        }
    }

    void run() {
        painter_.warm_up(); // while the worker opens the file
        while (!ended()) {
            frame();
        }
        if (!options_.screenshot.empty()) {
            write_png(options_.screenshot, painter_.picture());
        }
    }

    const std::shared_ptr<Device>& device() const { return device_; }
    Session& session() { return session_; }

  private:
    /// A script ends with its last line; a screenshot alone with the first picture that shows all.
    bool ended() const {
        if (panels_.files.quit()) {
            return true;
        }
        if (player_) {
            return player_->done();
        }
        return !options_.screenshot.empty() && painted_settled_ > 2;
    }

    bool unattended() const { return player_ || !options_.screenshot.empty(); }

    void frame() {
        log_.frame();
        take_events();
        log_.enter(FramePart::session);
        session_.update();
        const WindowSize size = window_.framebuffer_size();
        hidden_ = size.empty(); // minimized
        if (hidden_) {
            return;
        }
        session_.camera.set_window(size.width, size.height);
        const auto start = Clock::now();
        log_.enter(FramePart::panels);
        ui_.begin_frame(size, seconds_since(last_frame_));
        last_frame_ = start;
        const bool bare = panels_.files.wants_picture();
        const Scene scene = session_.scene();
        Marks marks(session_.camera, scene);
        if (!bare) {
            draw_overlay(session_, marks);
            panels_.show(session_, times_);
        }
        ImGui::Render();
        lose_what_is_wanted();
        // The CPU draws several samples a pixel only once all is at rest, and of a million triangles never:
        // that takes it seconds.
        const bool many = session_.shown().look->coarse != nullptr;
        const bool fine = !painter_.draws_on_cpu() || ((resting() || bare) && !many);
        const Painted painted = painter_.paint(scene, {marks.all(), *ImGui::GetDrawData()},
                                               {fine, bare || wants_picture(), !session_.in_motion()}, log_);
        fine_ = fine && painted == Painted::all;
        in_part_ = painted == Painted::in_part;
        log_.enter(FramePart::pictures);
        times_.milliseconds = 1000 * seconds_since(start);
        painted_settled_ =
            session_.settled() && session_.shown().mesh && !in_part_ ? painted_settled_ + 1 : 0;
        write_pictures();
        write_wanted_pictures(bare);
        complain_of_nothing();
    }

    /// Nobody reads the window: where nothing could be opened, its messages are the program's.
    void complain_of_nothing() const {
        if (!player_ && unattended() && session_.settled() && !session_.shown().mesh) {
            throw InputError(session_.notices().empty() ? "a screenshot wants a mesh or a recipe, or a script"
                                                        : session_.notices().back().text);
        }
    }

    /// For scripts.
    void lose_what_is_wanted() {
        const Loss loss = player_ != nullptr ? player_->take_loss() : Loss::none;
        if (loss == Loss::drawing) {
            throw DeviceError("the device that draws was lost");
        }
        if (loss == Loss::surface) {
            painter_.lose_surface();
        }
    }

    bool resting() const {
        if (unattended()) {
            return session_.settled() && !(player_ && player_->busy());
        }
        return seconds_since(last_change_) > rest_before;
    }

    /// A file is written of what is drawn next.
    bool wants_picture() const {
        return (player_ && player_->wants_picture()) ||
               (!options_.screenshot.empty() && (!player_ || player_->done()));
    }

    /// How long nothing needs to be drawn, unless something happens. What the worker does has cores of its
    /// own that way.
    double patience() const {
        if (hidden_) {
            return idle_wait;
        }
        if (in_part_ || frames_due_ > 0) {
            return 0;
        }
        if (unattended()) {
            return session_.settled() && !(player_ && player_->resting()) ? 0 : script_wait;
        }
        return !session_.settled() ? work_wait : fine_ ? idle_wait : rest_before;
    }

    void take_events() {
        const double wait = patience();
        log_.enter(wait > 0 ? FramePart::idle : FramePart::events);
        std::vector<InputEvent> events = window_.take_events(wait);
        log_.enter(FramePart::events);
        if (player_) {
            // Nobody is there: what the window itself says of mouse and keys would disturb the script.
            std::erase_if(events, [](const InputEvent& e) { return e.kind != InputEvent::Kind::close; });
            const std::vector<InputEvent> played = player_->next(session_, window_, log_);
            events.insert(events.end(), played.begin(), played.end());
        }
        events_.add(events);
        for (const InputEvent& event : events_.take_frame()) {
            handle(event);
        }
        const bool changed =
            !events.empty() || !events_.empty() || Ui::active() || shown_ != &session_.shown();
        shown_ = &session_.shown();
        frames_due_ = changed ? frames_after_event : std::max(frames_due_ - 1, 0);
        if (changed || !session_.settled()) {
            last_change_ = Clock::now();
        }
    }

    void handle(const InputEvent& event) {
        if (event.kind == InputEvent::Kind::close) {
            panels_.files.ask_to_quit(session_);
        } else if (!shortcut(event) && (!ui_.handle(event) || session_.editor.dragging())) {
            session_.handle(event);
        }
    }

    /// None while it is open what becomes of a lost session.
    bool shortcut(const InputEvent& event) {
        if (!session_.lost().empty()) {
            return false;
        }
        if (is_shortcut(event, "o")) {
            panels_.files.ask_to_open();
        } else if (is_shortcut(event, "s")) {
            event.modifiers.shift ? panels_.files.ask_to_save_as(session_) : panels_.files.save(session_);
        } else if (event.kind == InputEvent::Kind::key_down && event.key == key_of("F12")) {
            panels_.files.ask_to_save_picture(session_);
        } else {
            return false;
        }
        return true;
    }

    void write_pictures() {
        if (!player_) {
            return;
        }
        for (const std::string& file : player_->take_pictures()) {
            write_png(file, painter_.picture());
        }
    }

    /// Those that a person asked for: of the view alone.
    void write_wanted_pictures(bool drawn) {
        if (!drawn) {
            return;
        }
        for (const std::string& file : panels_.files.take_pictures()) {
            try {
                write_png(file, painter_.picture());
                session_.tell("saved " + file);
            } catch (const WriteError& error) {
                session_.complain(error.what());
            }
        }
        frames_due_ = frames_after_event; // the panels come back
    }

    ViewerOptions options_;
    Window window_;
    std::shared_ptr<Device> device_;
    Ui ui_;
    Disposer disposer_; ///< ends what is left of the painter and the session before the device goes
    Painter painter_;
    Session session_;
    Panels panels_;
    ScriptPlayer* player_ = nullptr;
    FrameTimes times_;
    FrameLog log_;
    Clock::time_point last_frame_ = Clock::now();
    Clock::time_point last_change_ = Clock::now();
    EventQueue events_;
    int frames_due_ = frames_after_event;
    int painted_settled_ = 0;
    const Shown* shown_ = nullptr; ///< when events were taken last
    bool fine_ = false;
    bool in_part_ = false; ///< the picture is not all there
    bool hidden_ = false;
};

} // namespace

void run_viewer(const ViewerOptions& options) {
    std::optional<ScriptPlayer> player;
    if (!options.script.empty()) {
        player.emplace(options.script);
    }
    // Kept while windows come and go: a server may end, or begin anew, when its last client leaves.
    const Display display;
    std::shared_ptr<Device> device;
    std::shared_ptr<LostSession> lost;
    std::string reason;
    for (int losses = 0;;) {
        Viewer viewer(display, options, player ? &*player : nullptr, lost);
        device = viewer.device();
        if (losses > 0) {
            viewer.session().complain("the device that draws failed (" + reason +
                                      "); the window was opened again, and undo begins here");
        }
        try {
            viewer.run();
            break;
        } catch (const DeviceError& error) {
            if (++losses > most_losses) {
                throw;
            }
            reason = error.what();
            lost = viewer.session().left_behind();
        }
    }
    check_validation(device);
}

} // namespace anvil
