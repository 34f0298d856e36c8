#pragma once
// Panels without a window: Dear ImGui fed with a mouse and keys by hand, nothing drawn (style.md §10).

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <string>

#include "app/editor/keys.h"
#include "app/editor/theme.h"
#include "app/editor/widget_places.h"

namespace voledit::test {

class PanelHarness {
public:
    using Draw = std::function<void()>;

    /// Draws `panel` within the scope "Panel", 340 × 1400 pixels.
    explicit PanelHarness(Draw panel) : panel_(std::move(panel)), context_(ImGui::CreateContext()) {
        ImGui::SetCurrentContext(context_);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1000, 1400};
        io.DeltaTime = 1.0f / 60;
        io.UserData = &places_;
        io.KeyMap[ImGuiKey_Escape] = int(Key::Escape);
        io.KeyMap[ImGuiKey_Backspace] = int(Key::Backspace);
        io.KeyMap[ImGuiKey_Enter] = int(Key::Enter);
        io.KeyMap[ImGuiKey_Delete] = int(Key::Delete);
        io.KeyMap[ImGuiKey_A] = int(Key::A);
        applyTheme(1);
        frame(3);
    }
    ~PanelHarness() { ImGui::DestroyContext(context_); }
    PanelHarness(const PanelHarness&) = delete;
    PanelHarness& operator=(const PanelHarness&) = delete;

    void frame(int count = 1) {
        for (int i = 0; i < count; ++i) {
            places_.newFrame();
            ImGui::NewFrame();
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({340, 1400});
            ImGui::Begin("##panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
            {
                const WidgetScope scope("Panel");
                panel_();
            }
            ImGui::End();
            ImGui::Render();
        }
        // What the last frame noted can be found only from the next on.
        places_.newFrame();
    }

    bool has(const std::string& label) const { return places_.find("Panel/" + label).has_value(); }
    WidgetPlace place(const std::string& label) const {
        const auto found = places_.find("Panel/" + label);
        if (!found) {
            std::string names;
            for (const auto& name : places_.names()) names += "\n  " + name;
            ADD_FAILURE() << "no widget Panel/" << label << "; there are" << names;
            return {};
        }
        return *found;
    }
    Vec2 at(const std::string& label) const { return place(label).center(); }

    void move(const Vec2& to) {
        ImGui::GetIO().MousePos = {float(to.x), float(to.y)};
        frame();
    }
    void button(bool down, int which = 0) {
        ImGui::GetIO().MouseDown[which] = down;
        frame();
    }
    void click(const Vec2& to, int which = 0) {
        move(to);
        button(true, which);
        button(false, which);
        // Far from the next click in time, so that two are no double click.
        ImGui::GetIO().DeltaTime = 1;
        frame();
        ImGui::GetIO().DeltaTime = 1.0f / 60;
    }
    void click(const std::string& label) { click(at(label)); }
    void doubleClick(const Vec2& to) {
        move(to);
        for (int i = 0; i < 2; ++i) {
            button(true);
            button(false);
        }
    }
    /// Presses, moves in four steps; the button stays down.
    void dragTo(const Vec2& from, const Vec2& to) {
        move(from);
        button(true);
        for (int step = 1; step <= 4; ++step) move(from + (to - from) * (step / 4.0));
    }
    void drag(const Vec2& from, const Vec2& to) {
        dragTo(from, to);
        button(false);
        frame();
    }
    void drag(const std::string& label, const Vec2& by) { drag(at(label), at(label) + by); }
    void press(Key key) {
        ImGui::GetIO().KeysDown[int(key)] = true;
        frame();
        ImGui::GetIO().KeysDown[int(key)] = false;
        frame();
    }
    void hold(Key key, bool down) {
        ImGuiIO& io = ImGui::GetIO();
        (key == Key::Ctrl ? io.KeyCtrl : key == Key::Shift ? io.KeyShift : io.KeyAlt) = down;
    }
    /// Types over the number in field `label` and confirms.
    void enter(const std::string& label, const std::string& text) {
        hold(Key::Ctrl, true);
        click(at(label));
        hold(Key::Ctrl, false);
        frame();
        for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        frame();
        press(Key::Enter);
        frame();
    }

private:
    Draw panel_;
    WidgetPlaces places_;
    ImGuiContext* context_;
};

}  // namespace voledit::test
