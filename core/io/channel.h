#pragma once
// A local socket that carries packets and, with a packet, an open file.

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace voledit {

/// Owns a file descriptor; move-only.
class FileDescriptor {
public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    ~FileDescriptor() { reset(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        if (this != &other) {
            reset();
            fd_ = std::exchange(other.fd_, -1);
        }
        return *this;
    }

    int get() const { return fd_; }
    explicit operator bool() const { return fd_ >= 0; }
    void reset();

private:
    int fd_;
};

struct Packet {
    std::vector<std::byte> bytes;
    FileDescriptor file;  // what came with it, or none
};

enum class Send { Wait, DropIfFull };

/// Sends one packet, and with it a copy of the descriptor `file` (−1: none). False where the other end is gone or, with
/// DropIfFull, where its queue is full. Never raises SIGPIPE.
bool sendPacket(int socket, std::span<const std::byte> bytes, int file = -1, Send mode = Send::Wait);

/// Waits for a packet, at most `milliseconds` (−1: for ever). nullopt after that time; an empty packet where the other
/// end is gone.
std::optional<Packet> receivePacket(int socket, int milliseconds);

/// Two connected ends; both close on exec. Throws Error where the system has no descriptors left.
std::pair<FileDescriptor, FileDescriptor> makeChannel();

}  // namespace voledit
