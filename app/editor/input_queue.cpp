#include "app/editor/input_queue.h"

#include <imgui.h>

#include <algorithm>

namespace voledit {

void InputQueue::push(std::span<const InputEvent> events) {
    waiting_.insert(waiting_.end(), events.begin(), events.end());
}

std::vector<InputEvent> InputQueue::takeFrame() {
    using Kind = InputEvent::Kind;
    std::vector<InputEvent> taken;
    bool button = false, acted = false;
    while (!waiting_.empty()) {
        const InputEvent& next = waiting_.front();
        const bool again = std::any_of(taken.begin(), taken.end(), [&](const InputEvent& e) {
            return (e.kind == next.kind && e.kind == Kind::Button && e.button == next.button) ||
                   (e.kind == next.kind && e.kind == Kind::Key && e.key == next.key);
        });
        const bool modifier = next.kind == Kind::Key && next.key >= Key::Shift;
        if (again || (next.kind == Kind::Move && button) || (modifier && acted)) break;
        button |= next.kind == Kind::Button;
        // Letting a key go does nothing by itself, so modifiers may go with it.
        acted |= next.kind != Kind::Move && !(next.kind == Kind::Key && (modifier || !next.down));
        const bool last = next.kind == Kind::Text || next.kind == Kind::Drop;
        taken.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
        if (last) break;
    }
    return taken;
}

void feedImGui(const std::vector<InputEvent>& events) {
    ImGuiIO& io = ImGui::GetIO();
    for (const InputEvent& event : events) switch (event.kind) {
            case InputEvent::Kind::Move:
                io.MousePos = ImVec2(float(event.at.x), float(event.at.y));
                break;
            case InputEvent::Kind::Button:
                io.MouseDown[int(event.button)] = event.down;
                break;
            case InputEvent::Kind::Wheel:
                io.MouseWheel += float(event.wheel);
                break;
            case InputEvent::Kind::Key:
                io.KeysDown[int(event.key)] = event.down;
                break;
            case InputEvent::Kind::Text:
                io.AddInputCharactersUTF8(event.text.c_str());
                break;
            case InputEvent::Kind::Drop:
                break;
        }
    io.KeyCtrl = io.KeysDown[int(Key::Ctrl)];
    io.KeyShift = io.KeysDown[int(Key::Shift)];
    io.KeyAlt = io.KeysDown[int(Key::Alt)];
    io.KeySuper = io.KeysDown[int(Key::Super)];
}

void mapImGuiKeys() {
    ImGuiIO& io = ImGui::GetIO();
    static_assert(kKeyCount <= IM_ARRAYSIZE(io.KeysDown));
    for (const auto& [theirs, ours] : {std::pair{ImGuiKey_Tab, Key::Tab},
                                       {ImGuiKey_LeftArrow, Key::Left},
                                       {ImGuiKey_RightArrow, Key::Right},
                                       {ImGuiKey_UpArrow, Key::Up},
                                       {ImGuiKey_DownArrow, Key::Down},
                                       {ImGuiKey_PageUp, Key::PageUp},
                                       {ImGuiKey_PageDown, Key::PageDown},
                                       {ImGuiKey_Home, Key::Home},
                                       {ImGuiKey_End, Key::End},
                                       {ImGuiKey_Insert, Key::Insert},
                                       {ImGuiKey_Delete, Key::Delete},
                                       {ImGuiKey_Backspace, Key::Backspace},
                                       {ImGuiKey_Space, Key::Space},
                                       {ImGuiKey_Enter, Key::Enter},
                                       {ImGuiKey_Escape, Key::Escape},
                                       {ImGuiKey_KeyPadEnter, Key::KeypadEnter},
                                       {ImGuiKey_A, Key::A},
                                       {ImGuiKey_C, Key::C},
                                       {ImGuiKey_V, Key::V},
                                       {ImGuiKey_X, Key::X},
                                       {ImGuiKey_Y, Key::Y},
                                       {ImGuiKey_Z, Key::Z}})
        io.KeyMap[theirs] = int(ours);
}

}  // namespace voledit
