#include "tests/support/fixtures.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace voledit::test {

namespace fs = std::filesystem;

std::optional<fs::path> shared(const std::string& path) {
    const fs::path full = fs::path(VOLEDIT_SHARED) / path;
    if (!fs::exists(full)) return std::nullopt;
    return full;
}

fs::path fixture(const std::string& path) {
    return fs::path(VOLEDIT_TESTS) / path;
}

namespace {
struct Scratch {
    std::vector<fs::path> folders;
    ~Scratch() {
        std::error_code ignored;
        for (const auto& f : folders) fs::remove_all(f, ignored);
    }
};

std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}
}  // namespace

fs::path scratchFolder() {
    static Scratch scratch;
    std::string name = (fs::temp_directory_path() / "voledit-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a scratch folder");
    scratch.folders.push_back(name);
    return name;
}

RunResult run(const std::string& program, const std::vector<std::string>& arguments, double timeout) {
    const fs::path folder = scratchFolder();
    const fs::path path = fs::read_symlink("/proc/self/exe").parent_path() / program;
    std::vector<std::string> all{path.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& a : all) argv.push_back(a.data());
    argv.push_back(nullptr);
    const std::string out = (folder / "out").string(), err = (folder / "err").string();

    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child == 0) {
        const int o = open(out.c_str(), O_CREAT | O_WRONLY, 0600), e = open(err.c_str(), O_CREAT | O_WRONLY, 0600);
        const int i = open("/dev/null", O_RDONLY);
        dup2(i, 0);
        dup2(o, 1);
        dup2(e, 2);
        execv(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    const auto elapsed = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    while (wait4(child, &status, WNOHANG, &usage) == 0) {
        if (elapsed() > timeout) kill(child, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contents(out), contents(err), elapsed(),
            std::size_t(usage.ru_maxrss) * 1024};
}

}  // namespace voledit::test
