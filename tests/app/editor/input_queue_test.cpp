#include "app/editor/input_queue.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

using E = InputEvent;

std::vector<std::size_t> framesOf(const std::vector<E>& events) {
    InputQueue queue;
    queue.push(events);
    std::vector<std::size_t> sizes;
    while (!queue.empty()) sizes.push_back(queue.takeFrame().size());
    return sizes;
}

TEST(InputQueue, AQuickClickTakesTwoFrames) {
    const std::vector<E> events{E::move({1, 2}), E::press(MouseButton::Left, true), E::press(MouseButton::Left, false)};
    EXPECT_EQ(framesOf(events), (std::vector<std::size_t>{2, 1}));
}

TEST(InputQueue, AMoveAfterAPressWaits) {
    EXPECT_EQ(framesOf({E::press(MouseButton::Left, true), E::move({5, 5}), E::move({6, 6})}),
              (std::vector<std::size_t>{1, 2}));
}

TEST(InputQueue, AModifierBelongsToTheKeyBeforeIt) {
    // Ctrl+S let go at once: in the frame of S, Ctrl must still be down.
    const std::vector<E> events{E::stroke(Key::Ctrl, true), E::stroke(Key::S, true), E::stroke(Key::Ctrl, false),
                                E::stroke(Key::S, false)};
    EXPECT_EQ(framesOf(events), (std::vector<std::size_t>{2, 2}));
}

TEST(InputQueue, NothingIsLostOrReordered) {
    const std::vector<E> events{
        E::typed("a"), E::typed("b"),           E::dropped("x"),          E::scroll(1),
        E::scroll(2),  E::stroke(Key::A, true), E::stroke(Key::A, false), E::stroke(Key::A, true)};
    InputQueue queue;
    queue.push(events);
    std::vector<E> taken;
    while (!queue.empty())
        for (const E& event : queue.takeFrame()) taken.push_back(event);
    EXPECT_EQ(taken, events);
    EXPECT_TRUE(queue.takeFrame().empty());
}

}  // namespace
}  // namespace voledit
