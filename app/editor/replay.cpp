#include "app/editor/replay.h"

#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace voledit {
namespace {

// Two clicks within this many frames are a double click to the interface; lines that are clicks of their own must not
// become one.
constexpr int kDoubleClickFrames = 24;

class Player {
public:
    explicit Player(EventHost& host) : host_(host) {}

    void play(const Event& event) {
        using Kind = Event::Kind;
        switch (event.kind) {
            case Kind::Frame:
                for (int n = 0; n < event.count && !host_.closed(); ++n) frame();
                break;
            case Kind::Move:
                moveTo(locate(event.from));
                break;
            case Kind::Down:
            case Kind::Up:
                waiting_.push_back(InputEvent::press(event.button, event.kind == Kind::Down));
                break;
            case Kind::Wheel:
                waiting_.push_back(InputEvent::scroll(event.wheel));
                break;
            case Kind::Click:
                click(event.from, 1);
                break;
            case Kind::DoubleClick:
                click(event.from, 2);
                break;
            case Kind::Drag:
                drag(event);
                break;
            case Kind::Press:
                press(event.chord);
                break;
            case Kind::Hold:
            case Kind::Release:
                waiting_.push_back(InputEvent::stroke(event.key, event.kind == Kind::Hold));
                break;
            case Kind::Text:
                waiting_.push_back(InputEvent::typed(event.text));
                break;
            case Kind::Drop:
                waiting_.push_back(InputEvent::dropped(event.text));
                break;
            default:
                settle();
                command(event);
        }
    }

    // Draws what still waits.
    void settle() {
        while ((!waiting_.empty() || host_.inputWaits()) && !host_.closed()) frame();
    }

private:
    void frame() {
        host_.frame(waiting_);
        waiting_.clear();
        ++sinceClick_;
    }

    void frameWith(InputEvent event) {
        waiting_.push_back(std::move(event));
        settle();
    }

    Vec2 locate(const Place& place) {
        if (place.kind == Place::Kind::Pixel) return host_.locate(place);
        settle();
        if (place.kind != Place::Kind::Here) return host_.locate(place);
        Place there;
        there.at = mouse_;
        there.offset = place.offset;
        return host_.locate(there);
    }

    void moveTo(const Vec2& at) {
        mouse_ = at;
        waiting_.push_back(InputEvent::move(at));
    }

    void click(const Place& place, int times) {
        const Vec2 at = locate(place);
        if (glm::distance(at, clickedAt_) < 16)
            while (sinceClick_ < kDoubleClickFrames && !host_.closed()) frame();
        moveTo(at);
        settle();
        for (int n = 0; n < times; ++n) {
            frameWith(InputEvent::press(MouseButton::Left, true));
            frameWith(InputEvent::press(MouseButton::Left, false));
        }
        clickedAt_ = at;
        sinceClick_ = 0;
        frame();
    }

    void drag(const Event& event) {
        const Vec2 from = locate(event.from);
        mouse_ = from;
        const Vec2 to = locate(event.to);
        moveTo(from);
        settle();
        frameWith(InputEvent::press(MouseButton::Left, true));
        for (int n = 1; n <= event.count; ++n) {
            moveTo(from + (to - from) * (double(n) / event.count));
            settle();
        }
        frameWith(InputEvent::press(MouseButton::Left, false));
        frame();
    }

    void press(const Chord& chord) {
        const auto modifiers = [&](bool down) {
            if (chord.ctrl) waiting_.push_back(InputEvent::stroke(Key::Ctrl, down));
            if (chord.alt) waiting_.push_back(InputEvent::stroke(Key::Alt, down));
            if (chord.shift) waiting_.push_back(InputEvent::stroke(Key::Shift, down));
        };
        modifiers(true);
        frameWith(InputEvent::stroke(chord.key, true));
        waiting_.push_back(InputEvent::stroke(chord.key, false));
        modifiers(false);
        settle();
        frame();
    }

    void command(const Event& event) {
        switch (event.kind) {
            case Event::Kind::Do:
                host_.act(event.text, event.argument);
                // Windows that appear are laid out in one frame and seen in the next.
                for (int n = 0; n < 2 && !host_.closed(); ++n) frame();
                break;
            case Event::Kind::Wait:
                host_.waitIdle();
                break;
            case Event::Kind::Screenshot:
                host_.saveScreenshot(event.text);
                break;
            case Event::Kind::State:
                host_.saveState(event.text);
                break;
            default:
                break;
        }
    }

    EventHost& host_;
    std::vector<InputEvent> waiting_;
    Vec2 mouse_{0};
    Vec2 clickedAt_{-1000};
    int sinceClick_ = kDoubleClickFrames;
};

}  // namespace

void replay(const std::vector<Event>& events, const std::string& file, EventHost& host) {
    Player player(host);
    for (const Event& event : events) {
        if (host.closed()) return;
        try {
            player.play(event);
        } catch (const Error& error) {
            throw Error(file + ":" + std::to_string(event.line) + ": " + error.what());
        }
    }
    player.settle();
}

}  // namespace voledit
