#include "app/scripting/wire/ScriptMessage.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <poll.h>
#include <sys/socket.h>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

constexpr std::chrono::milliseconds kLook{100};
constexpr std::size_t kHead = 4;

tl::unexpected<Error> gone() { return fail(ErrorCode::Io, "the script's process is gone"); }

/// Moves bytes through a socket, whatever the other end does.
class Mover {
public:
    Mover(int socket, const WhileWaiting& waiting) : socket_(socket), waiting_(waiting) {}

    /// Moves all bytes, or returns an error. `move`: recv() or send() of the remaining bytes.
    template <class Move>
    Result<void> all(std::size_t size, short when, Move move) {
        for (std::size_t done = 0; done < size;) {
            if (auto looked = look(); !looked) return looked;
            const ssize_t n = move(done);
            if (n > 0) {
                done += static_cast<std::size_t>(n);
            } else if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
                pollfd ready{socket_, when, 0};
                if (::poll(&ready, 1, waiting_ ? static_cast<int>(kLook.count()) : -1) < 0 && errno != EINTR)
                    return gone();
            } else if (n == 0 || errno != EINTR) {
                return gone();
            }
        }
        return {};
    }

private:
    /// Checks the elapsed time: an end that sends a byte now and then gets no more time than a silent one.
    Result<void> look() {
        if (!waiting_ || std::chrono::steady_clock::now() < next_) return {};
        next_ = std::chrono::steady_clock::now() + kLook;
        return waiting_();
    }

    int socket_;
    const WhileWaiting& waiting_;
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kLook;
};

}  // namespace

Result<void> sendMessage(int socket, const nlohmann::json& message, const WhileWaiting& waiting) {
    std::string frame(kHead, '\0');
    appendCbor(message, frame);
    const std::size_t size = frame.size() - kHead;
    if (size > kMaxFrame) {
        return fail(ErrorCode::InvalidArgument, "{} bytes were handed over at once; at most {} are accepted", size,
                    kMaxFrame);
    }
    for (std::size_t i = 0; i < kHead; ++i) frame[i] = static_cast<char>(size >> (8 * i) & 0xFFU);
    return Mover(socket, waiting).all(frame.size(), POLLOUT, [&](std::size_t done) {
        return ::send(socket, frame.data() + done, frame.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    });
}

Result<nlohmann::json> receiveMessage(int socket, const WhileWaiting& waiting) {
    Mover mover(socket, waiting);
    const auto read = [&](char* to, std::size_t size) {
        return mover.all(size, POLLIN, [&, to, size](std::size_t done) {
            return ::recv(socket, to + done, size - done, MSG_DONTWAIT);
        });
    };
    std::array<char, kHead> head{};
    if (auto got = read(head.data(), head.size()); !got) return failure(got);
    std::size_t size = 0;
    for (std::size_t i = 0; i < kHead; ++i)
        size |= static_cast<std::size_t>(static_cast<unsigned char>(head[i])) << (8 * i);
    if (size > kMaxFrame) return fail(ErrorCode::ParseError, "a message of {} bytes", size);
    std::string frame;
    constexpr std::size_t kBlock = std::size_t{1} << 20;  // read in blocks, because announced bytes may never come
    while (frame.size() < size) {
        const std::size_t have = frame.size();
        frame.resize(std::min(size, have + kBlock));
        if (auto got = read(frame.data() + have, frame.size() - have); !got) return failure(got);
    }
    // A message is an object that holds a list of arguments.
    return parseCbor(frame, "a message",
                     {.bytes = kMaxFrame, .depth = kMaxScriptDepth + 3, .values = kMaxValues + 100});
}

std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return std::string(text.substr(0, end)) + "…";
}

}  // namespace tacto
