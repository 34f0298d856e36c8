#include "app/editor/recorder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "app/editor/event_words.h"
#include "app/editor/events.h"
#include "core/base/error.h"

namespace voledit {
namespace {

constexpr double kLongestRest = 120;  // frames
constexpr const char* kWindowMark = "# window ";

Event eventOf(const InputEvent& input) {
    Event event;
    switch (input.kind) {
        case InputEvent::Kind::Move:
            event.kind = Event::Kind::Move;
            event.from.at = input.at;
            break;
        case InputEvent::Kind::Button:
            event.kind = input.down ? Event::Kind::Down : Event::Kind::Up;
            event.button = input.button;
            break;
        case InputEvent::Kind::Wheel:
            event.kind = Event::Kind::Wheel;
            event.wheel = input.wheel;
            break;
        case InputEvent::Kind::Key:
            event.kind = input.down ? Event::Kind::Hold : Event::Kind::Release;
            event.key = input.key;
            break;
        case InputEvent::Kind::Text:
            event.kind = Event::Kind::Text;
            event.text = input.text;
            break;
        case InputEvent::Kind::Drop:
            event.kind = Event::Kind::Drop;
            event.text = input.text;
            break;
    }
    return event;
}

}  // namespace

std::string lineOf(const RecordedWindow& window) {
    return kWindowMark + std::to_string(window.size.x) + "x" + std::to_string(window.size.y) + ", scale " +
           numberText(window.scale);
}

std::optional<RecordedWindow> recordedWindow(const std::string& text) {
    const auto at = text.find(kWindowMark);
    if (at == text.npos) return std::nullopt;
    RecordedWindow window;
    char by = 0;
    std::string comma, scale;
    std::istringstream line(text.substr(at + std::string(kWindowMark).size(), 80));
    if (!(line >> window.size.x >> by >> window.size.y >> comma >> scale >> window.scale)) return std::nullopt;
    const bool sane = by == 'x' && std::min(window.size.x, window.size.y) >= 64 &&
                      std::max(window.size.x, window.size.y) <= 16384 && window.scale >= 0.5 && window.scale <= 4;
    return sane ? std::optional(window) : std::nullopt;
}

Recorder::Recorder(const std::filesystem::path& path, const RecordedWindow& window) : file_(path) {
    if (!file_)
        throw Error(path.string(), "the events cannot be written there", "name a file in a folder you may write");
    file_ << "# voledit events\n" << lineOf(window) << "\n" << std::flush;
}

Recorder::~Recorder() {
    writeFrames();
}

void Recorder::writeFrames() {
    const int count = int(std::lround(std::min(frames_, std::max(played_, kLongestRest))));
    frames_ = played_ = 0;
    if (count < 1) return;
    Event event;
    event.count = count;
    file_ << lineOf(event) << "\n" << std::flush;
}

void Recorder::frame(const std::vector<InputEvent>& events, double seconds, bool played) {
    if (!events.empty()) writeFrames();
    for (const InputEvent& event : events) file_ << lineOf(eventOf(event)) << "\n";
    if (!events.empty()) file_ << std::flush;
    // Every frame with input must be one in the replay too, however fast the screen is.
    const double frames = events.empty() ? seconds * 60 : std::max(1.0, seconds * 60);
    frames_ += frames;
    if (played) played_ += frames;
}

void Recorder::action(const std::string& id, const std::string& argument) {
    writeFrames();
    Event event;
    event.kind = Event::Kind::Do;
    event.text = id;
    event.argument = argument;
    file_ << lineOf(event) << "\n" << std::flush;
}

void Recorder::loaded() {
    writeFrames();
    Event event;
    event.kind = Event::Kind::Wait;
    file_ << lineOf(event) << "\n" << std::flush;
}

}  // namespace voledit
