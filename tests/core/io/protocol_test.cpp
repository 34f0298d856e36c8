#include "core/io/protocol.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/channel.h"
#include "core/io/memory_file.h"

namespace voledit {
namespace {

IoReply fullReply() {
    IoReply reply;
    reply.kind = IoReply::Kind::Volume;
    reply.fraction = 0.25;
    reply.message = "message";
    reply.format = "nrrd";
    reply.storedType = "int64";
    reply.grid.size = {3, 4, 5};
    reply.grid.channels = 2;
    reply.grid.worldFromIndex[3] = Vec4(1, 2, 3, 1);
    reply.type = VoxelType::Int16;
    reply.statistics = {-1, 2, 0.5, std::vector<std::uint64_t>(256, 7)};
    reply.notes = {"one", "two"};
    reply.textBytes = 1234567890123;
    return reply;
}

TEST(Protocol, RepliesArriveWhole) {
    const IoReply sent = fullReply(), reply = unpackReply(pack(sent));
    EXPECT_EQ(reply.kind, sent.kind);
    EXPECT_EQ(reply.fraction, sent.fraction);
    EXPECT_EQ(reply.message, sent.message);
    EXPECT_EQ(reply.format, sent.format);
    EXPECT_EQ(reply.storedType, sent.storedType);
    EXPECT_EQ(reply.grid, sent.grid);
    EXPECT_EQ(reply.type, sent.type);
    EXPECT_EQ(reply.statistics.mean, sent.statistics.mean);
    EXPECT_EQ(reply.statistics.histogram, sent.statistics.histogram);
    EXPECT_EQ(reply.notes, sent.notes);
    EXPECT_EQ(reply.textBytes, sent.textBytes);
}

TEST(Protocol, RequestsArriveWhole) {
    IoRequest sent;
    sent.task = IoTask::WriteVolume;
    sent.path = "/a/b";
    sent.shownPath = "b";
    sent.raw = RawFormat{{1, 2, 3}, VoxelType::Double, Vec3(4), true};
    sent.memoryLimit = 5;
    const IoRequest request = unpackRequest(pack(sent));
    EXPECT_EQ(request.task, sent.task);
    EXPECT_EQ(request.path, sent.path);
    EXPECT_EQ(request.shownPath, sent.shownPath);
    ASSERT_TRUE(request.raw);
    EXPECT_EQ(request.raw->size, Index3(1, 2, 3));
    EXPECT_TRUE(request.raw->bigEndian);
    EXPECT_FALSE(request.spacing);
    EXPECT_EQ(request.memoryLimit, 5u);
}

TEST(Protocol, ShortAndLongPacketsAreRefused) {
    auto packet = pack(fullReply());
    for (std::size_t n = 0; n < packet.size(); ++n)
        EXPECT_THROW(unpackReply(std::span(packet).first(n)), Error) << n << " bytes";
    packet.push_back(std::byte(0));
    EXPECT_THROW(unpackReply(packet), Error);
}

TEST(Protocol, UnknownKindsAreRefused) {
    auto packet = pack(fullReply());
    packet[0] = std::byte(200);
    EXPECT_THROW(unpackReply(packet), Error);
}

TEST(Protocol, EndlessTextsAreCutToAPacket) {
    IoReply reply = fullReply();
    reply.message = std::string(10 << 20, 'x');
    for (const auto& [notes, length] : {std::pair(100, 100000), std::pair(100000, 100)}) {
        reply.notes.assign(std::size_t(notes), std::string(std::size_t(length), 'y'));
        const auto packet = pack(reply);
        EXPECT_LE(packet.size(), kLongestPacket);
        EXPECT_NO_THROW(unpackReply(packet));
    }
}

TEST(Channel, CarriesAnOpenFile) {
    const auto [ours, theirs] = makeChannel();
    const FileDescriptor file = makeMemoryFile(4);
    {
        const MappedBytes mapping = mapForWriting(file.get(), 4);
        mapping.bytes[2] = std::byte(42);
    }
    seal(file.get());
    const std::byte message{1};
    ASSERT_TRUE(sendPacket(ours.get(), std::span(&message, 1), file.get()));
    const auto packet = receivePacket(theirs.get(), 1000);
    ASSERT_TRUE(packet && packet->file);
    const auto [bytes, owner] = mapSealed(packet->file.get(), 4);
    EXPECT_EQ(bytes[2], std::byte(42));
}

TEST(Channel, TellsSilenceFromTheEnd) {
    auto [ours, theirs] = makeChannel();
    EXPECT_FALSE(receivePacket(ours.get(), 0));
    theirs.reset();
    const auto packet = receivePacket(ours.get(), 1000);
    ASSERT_TRUE(packet);
    EXPECT_TRUE(packet->bytes.empty());
    const std::byte message{1};
    EXPECT_FALSE(sendPacket(ours.get(), std::span(&message, 1)));
}

TEST(MemoryFile, OnlySealedFilesOfTheRightSizeAreBelieved) {
    const FileDescriptor file = makeMemoryFile(100);
    EXPECT_THROW(mapSealed(file.get(), 100), Error);
    seal(file.get());
    EXPECT_NO_THROW(mapSealed(file.get(), 100));
    EXPECT_THROW(mapSealed(file.get(), 101), Error);
    EXPECT_THROW(mapForWriting(file.get(), 100), Error);
    EXPECT_THROW(mapSealed(-1, 100), Error);
}

}  // namespace
}  // namespace voledit
