#include "app/animation/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "core/base/error.h"

namespace voledit {
namespace {

std::string nextLine(ChildProcess& child) {
    for (;;) {
        if (auto line = child.readLine()) return *line;
        if (child.outputEnded()) return "(ended)";
        usleep(1000);
    }
}

ChildProcess::Settings shell(const std::string& script) {
    return {.command = {"sh", "-c", script}, .environment = {}, .keepErrors = true};
}

TEST(ChildProcess, AnswersLineByLine) {
    ChildProcess child(shell("while read x; do echo \"got $x\"; done; echo end; printf unfinished; exit 3"));
    EXPECT_TRUE(child.write("one\n"));
    EXPECT_EQ(nextLine(child), "got one");
    EXPECT_FALSE(child.outputEnded());
    EXPECT_TRUE(child.write("two\nthree\n"));
    EXPECT_EQ(nextLine(child), "got two");
    EXPECT_EQ(nextLine(child), "got three");
    child.closeInput();
    EXPECT_EQ(nextLine(child), "end");
    EXPECT_EQ(nextLine(child), "(ended)");
    EXPECT_EQ(child.wait(), 3);
    EXPECT_EQ(child.causeOfDeath(), "exit status 3");
}

TEST(ChildProcess, KeepsTheEndOfItsErrors) {
    ChildProcess child(shell("i=0; while [ $i -lt 2000 ]; do echo line $i >&2; i=$((i+1)); done; echo last >&2"));
    child.wait();
    EXPECT_LE(child.errors().size(), 4096u);
    EXPECT_TRUE(child.errors().ends_with("line 1999\nlast\n"));
}

TEST(ChildProcess, SaysWhichSignalKilledIt) {
    ChildProcess child(shell("exec sleep 100"));
    child.signal(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM);
    EXPECT_NE(child.causeOfDeath().find("signal 15"), std::string::npos);
}

TEST(ChildProcess, WritingToOneThatIsGoneFails) {
    std::signal(SIGPIPE, SIG_IGN);
    ChildProcess child(shell("exit 0"));
    child.wait();
    EXPECT_FALSE(child.write(std::string(1 << 20, 'x')));
}

TEST(ChildProcess, EnvironmentIsChangedWhereSaid) {
    setenv("VOLEDIT_TEST_A", "old", 1);
    setenv("VOLEDIT_TEST_B", "kept", 1);
    auto settings = shell("echo $VOLEDIT_TEST_A $VOLEDIT_TEST_B");
    settings.environment = {"VOLEDIT_TEST_A=new"};
    ChildProcess child(settings);
    EXPECT_EQ(nextLine(child), "new kept");
}

TEST(ChildProcess, EndsWithItsOwner) {
    pid_t id = 0;
    {
        ChildProcess child(shell("echo $$; exec sleep 100"));
        id = std::atoi(nextLine(child).c_str());
        ASSERT_GT(id, 1);
        EXPECT_EQ(kill(id, 0), 0);
    }
    EXPECT_NE(kill(id, 0), 0);
}

TEST(ChildProcess, MissingProgramsAreErrors) {
    EXPECT_THROW(ChildProcess({.command = {"/no/such/program"}, .environment = {}, .keepErrors = false}), Error);
    EXPECT_TRUE(programIsInstalled("sh"));
    EXPECT_FALSE(programIsInstalled("no-such-program-of-any-package"));
}

}  // namespace
}  // namespace voledit
