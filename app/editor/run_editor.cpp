#include "app/editor/run_editor.h"

#include <cstdio>
#include <fstream>
#include <sstream>

#include "app/editor/session.h"
#include "core/base/error.h"
#include "core/io/reduced_volumes.h"

namespace voledit {

namespace {

std::string textOfFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// A recording says which window it was made in; flags say otherwise where they are given.
EditorOptions withRecordedWindow(EditorOptions options) {
    const auto window = recordedWindow(textOfFile(options.play));
    if (!window) return options;
    if (!options.size) options.size = window->size;
    if (options.scale <= 0) options.scale = window->scale;
    return options;
}

void printActions() {
    IoClient io;
    EditorSettings settings;
    settings.headless = true;
    const Editor editor(settings, io);
    std::fputs(listOf(editor.workspace().actions).c_str(), stdout);
}

}  // namespace

int runEditor(const EditorOptions& given) {
    if (given.listActions) {
        printActions();
        return 0;
    }
    std::vector<Event> events;
    if (!given.play.empty()) events = loadEvents(given.play);
    const EditorOptions options = given.play.empty() ? given : withRecordedWindow(given);
    setMayReduceVolumes(true);
    Session session(options);
    int status = 0;
    try {
        replay(events, options.play.string(), session);
        if (options.headless) session.finishRendering();
    } catch (const Error& error) {
        std::fprintf(stderr, "voledit: %s\n", error.what());
        status = 1;
    }
    // With an event file the window stays for the user to go on, unless the file was to give a result.
    if (!options.headless && options.screenshot.empty() && status == 0 && !session.closed()) session.runWindow();
    if (!options.screenshot.empty() && status == 0) {
        session.waitIdle();
        session.saveScreenshot(options.screenshot.string());
    }
    return status;
}

}  // namespace voledit
