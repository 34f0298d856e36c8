#include "core/io/io_client.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

fs::path smallNrrd(const fs::path& folder, const char* name = "small.nrrd") {
    return test::writeFile(folder / name, "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n" +
                                              test::bytesOf(test::counting<std::uint8_t>(8)));
}

/// 400 MB of compressed zeros in a 400 KB file: takes a second or so to read.
fs::path slowNrrd(const fs::path& folder) {
    const std::string zeros = test::gzipped(std::string(40 << 20, '\0'));
    std::string data;
    for (int i = 0; i < 10; ++i) data += zeros;
    return test::writeFile(folder / "slow.nrrd",
                           "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1024 1024 400\nencoding: gzip\n\n" + data);
}

TEST(IoClient, StartsNothingUntilAsked) {
    IoClient io;
    EXPECT_EQ(io.processId(), 0);
    io.readVolume(smallNrrd(test::scratchFolder()));
    EXPECT_GT(io.processId(), 0);
}

TEST(IoClient, ServesManyCallsFromOneProcess) {
    const fs::path path = smallNrrd(test::scratchFolder());
    IoClient io;
    io.readVolume(path);
    const int first = io.processId();
    for (int i = 0; i < 20; ++i) io.readVolume(path);
    EXPECT_THROW(io.readVolume(path.string() + ".none"), Error);
    io.readVolume(path);
    EXPECT_EQ(io.processId(), first);
}

TEST(IoClient, VolumeOutlivesClientAndFile) {
    const fs::path path = smallNrrd(test::scratchFolder());
    std::shared_ptr<const Volume> volume;
    {
        IoClient io;
        volume = io.readVolume(path).volume;
    }
    fs::remove(path);
    EXPECT_EQ(volume->at({1, 1, 1}), 7);
}

TEST(IoClient, MovesTheProgressToItsEnd) {
    Progress progress;
    IoClient io;
    io.readVolume(smallNrrd(test::scratchFolder()), {}, &progress);
    EXPECT_EQ(progress.fraction(), 1);
}

TEST(IoClient, ReportsProgressOnTheWay) {
    const fs::path path = slowNrrd(test::scratchFolder());
    Progress progress;
    std::atomic<bool> done{false};
    double between = 0;
    std::thread watcher([&] {
        while (!done) {
            const double f = progress.fraction();
            if (f > 0 && f < 1) between = f;
            std::this_thread::sleep_for(1ms);
        }
    });
    IoClient io;
    io.readVolume(path, {}, &progress);
    done = true;
    watcher.join();
    EXPECT_GT(between, 0);
}

TEST(IoClient, CancelsAReadAndServesTheNext) {
    const fs::path folder = test::scratchFolder(), path = slowNrrd(folder);
    IoClient io;
    Progress progress;
    std::thread canceller([&] {
        while (progress.fraction() == 0) std::this_thread::sleep_for(1ms);
        progress.cancel();
    });
    EXPECT_THROW(io.readVolume(path, {}, &progress), Cancelled);
    canceller.join();
    EXPECT_EQ(io.processId(), 0) << "the parser still works on what nobody wants";
    EXPECT_EQ(io.readVolume(smallNrrd(folder)).format, "nrrd");
}

TEST(IoClient, CancelsBeforeItBegins) {
    IoClient io;
    Progress progress;
    progress.cancel();
    EXPECT_THROW(io.readVolume(smallNrrd(test::scratchFolder()), {}, &progress), Cancelled);
}

TEST(IoClient, CancelledWriteLeavesNothing) {
    VolumeGrid grid;
    grid.size = {512, 512, 256};
    const auto volume = Volume::fromValues(grid, std::vector<std::uint8_t>(grid.valueCount(), 1));
    const fs::path folder = test::scratchFolder();
    IoClient io;
    Progress progress;
    std::thread canceller([&] {
        while (progress.fraction() <= 0.2) std::this_thread::sleep_for(1ms);
        progress.cancel();
    });
    EXPECT_THROW(io.writeVolume(*volume, folder / "a.nii.gz", &progress), Cancelled);
    canceller.join();
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(IoClient, SaysThatAParserWasKilledAndStartsAnother) {
    const fs::path folder = test::scratchFolder(), path = slowNrrd(folder);
    IoClient io;
    Progress progress;
    std::thread killer([&] {
        while (progress.fraction() == 0) std::this_thread::sleep_for(1ms);
        kill(io.processId(), SIGKILL);
    });
    std::string message;
    try {
        io.readVolume(path, {}, &progress);
    } catch (const Error& error) {
        message = error.what();
    }
    killer.join();
    EXPECT_THAT(message, testing::AllOf(testing::HasSubstr("slow.nrrd"), testing::HasSubstr("signal 9")));
    EXPECT_EQ(io.readVolume(smallNrrd(folder)).format, "nrrd");
}

TEST(IoClient, RestartsAParserThatDiedWhileIdle) {
    const fs::path path = smallNrrd(test::scratchFolder());
    IoClient io;
    io.readVolume(path);
    const int first = io.processId();
    kill(first, SIGKILL);
    siginfo_t info;
    waitid(P_PID, id_t(first), &info, WEXITED | WNOWAIT);
    EXPECT_EQ(io.readVolume(path).format, "nrrd");
    EXPECT_NE(io.processId(), first);
}

TEST(IoClient, GivesUpOnAParserThatHangs) {
    const fs::path path = smallNrrd(test::scratchFolder());
    IoClient io({}, {.processorSeconds = 8, .wallSeconds = 0.3});
    io.readVolume(path);
    kill(io.processId(), SIGSTOP);
    std::string message;
    try {
        io.readVolume(path);
    } catch (const Error& error) {
        message = error.what();
    }
    EXPECT_THAT(message, testing::HasSubstr("small.nrrd"));
    EXPECT_EQ(io.readVolume(path).format, "nrrd");
}

TEST(IoClient, SaysThatTheProgramIsMissing) {
    IoClient io("/nowhere/voledit-io");
    try {
        io.readVolume(smallNrrd(test::scratchFolder()));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("/nowhere/voledit-io"), testing::HasSubstr("; ")));
    }
}

TEST(IoClient, SurvivesAProgramThatIsNoParser) {
    IoClient io("/bin/true");
    EXPECT_THROW(io.readVolume(smallNrrd(test::scratchFolder())), Error);
}

TEST(IoClient, ServesThreadsInTurn) {
    const fs::path path = smallNrrd(test::scratchFolder());
    IoClient io;
    std::atomic<int> good{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 10; ++i) good += io.readVolume(path).volume->at({1, 0, 0}) == 1;
        });
    for (auto& t : threads) t.join();
    EXPECT_EQ(good, 40);
}

TEST(IoClient, ParserOutlivesTheThreadThatStartedIt) {
    const fs::path path = smallNrrd(test::scratchFolder());
    IoClient io;
    std::thread([&] { io.readVolume(path); }).join();
    const int first = io.processId();
    std::this_thread::sleep_for(50ms);
    io.readVolume(path);
    EXPECT_EQ(io.processId(), first);
}

TEST(IoClient, ParserEndsWithTheProgramThatStartedIt) {
    const fs::path path = slowNrrd(test::scratchFolder());
    int report[2];
    ASSERT_EQ(pipe(report), 0);
    const pid_t child = fork();
    if (child == 0) {
        IoClient io;
        Progress progress;
        std::thread reader([&] { io.readVolume(path, {}, &progress); });
        while (progress.fraction() == 0) std::this_thread::sleep_for(1ms);
        const int id = io.processId();
        _exit(write(report[1], &id, sizeof id) == sizeof id ? 0 : 1);  // without any clean-up
    }
    int id = 0;
    ASSERT_EQ(read(report[0], &id, sizeof id), ssize_t(sizeof id));
    waitpid(child, nullptr, 0);
    close(report[0]);
    close(report[1]);
    bool gone = false;
    for (int i = 0; i < 500 && !gone; ++i) {
        std::ifstream status("/proc/" + std::to_string(id) + "/stat");
        std::string number, name, state;
        gone = !(status >> number >> name >> state) || state == "Z";
        std::this_thread::sleep_for(10ms);
    }
    EXPECT_TRUE(gone) << "voledit-io " << id << " lives on";
}

TEST(IoClient, KeepsToTheMemoryLimit) {
    const fs::path path = slowNrrd(test::scratchFolder());
    IoClient io;
    ReadOptions options;
    options.memoryLimit = 100 << 20;
    const std::string message = test::rejection(io, path, options);
    EXPECT_THAT(message, testing::HasSubstr("--memory-limit"));
    options.memoryLimit = 0;
    EXPECT_EQ(io.readVolume(path, options).volume->grid().size, Index3(1024, 1024, 400));
}

TEST(IoClient, NamesTheFileAsTheUserDid) {
    const fs::path folder = test::scratchFolder(), before = fs::current_path();
    fs::current_path(folder);
    IoClient io;
    std::string message;
    try {
        io.readVolume("missing.nrrd");
    } catch (const Error& error) {
        message = error.what();
    }
    fs::current_path(before);
    EXPECT_TRUE(message.starts_with("missing.nrrd: ")) << message;
}

}  // namespace
}  // namespace voledit
