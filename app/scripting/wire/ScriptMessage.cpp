#include "app/scripting/wire/ScriptMessage.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;
constexpr std::chrono::milliseconds kLook{100};
constexpr std::size_t kHead = 4;

tl::unexpected<Error> gone() { return fail(ErrorCode::Io, "the script's process is gone"); }

class FrameReader {
public:
    FrameReader(int socket, std::optional<SteadyTime> deadline, const std::function<Result<void>()>& idle)
        : socket_(socket), deadline_(deadline), idle_(idle) {}

    Result<void> read(char* to, std::size_t size) {
        for (std::size_t got = 0; got < size;) {
            const ssize_t n = ::recv(socket_, to + got, size - got, MSG_DONTWAIT);
            if (n == 0) return gone();
            if (n > 0) {
                got += static_cast<std::size_t>(n);
            } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
                if (auto waited = wait(); !waited) return waited;
            } else if (errno != EINTR) {
                return gone();
            }
        }
        return {};
    }

private:
    Result<void> wait() const {
        auto wait_ms = static_cast<int>(kLook.count());
        if (deadline_) {
            const auto left =
                std::chrono::ceil<std::chrono::milliseconds>(*deadline_ - std::chrono::steady_clock::now());
            if (left.count() <= 0) return fail(ErrorCode::Timeout, "no answer in time");
            wait_ms = std::min(wait_ms, static_cast<int>(std::min<std::int64_t>(left.count(), wait_ms)));
        } else if (!idle_) {
            wait_ms = -1;
        }
        pollfd in{socket_, POLLIN, 0};
        const int ready = ::poll(&in, 1, wait_ms);
        if (ready < 0 && errno != EINTR) return gone();
        return ready == 0 && idle_ ? idle_() : Result<void>();
    }

    int socket_;
    std::optional<SteadyTime> deadline_;
    const std::function<Result<void>()>& idle_;
};

Result<void> sendAll(int socket, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return gone();
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return {};
}

}  // namespace

Result<void> sendMessage(int socket, const nlohmann::json& message) {
    std::string frame(kHead, '\0');
    appendCbor(message, frame);
    const std::size_t size = frame.size() - kHead;
    if (size > kMaxFrame) {
        return fail(ErrorCode::InvalidArgument, "{} bytes were handed over at once; at most {} are accepted", size,
                    kMaxFrame);
    }
    for (std::size_t i = 0; i < kHead; ++i) frame[i] = static_cast<char>(size >> (8 * i) & 0xFFU);
    return sendAll(socket, frame);
}

Result<nlohmann::json> receiveMessage(int socket, std::optional<SteadyTime> deadline,
                                      const std::function<Result<void>()>& idle) {
    FrameReader reader(socket, deadline, idle);
    std::array<char, kHead> head{};
    if (auto read = reader.read(head.data(), head.size()); !read) return failure(read);
    std::size_t size = 0;
    for (std::size_t i = 0; i < kHead; ++i)
        size |= static_cast<std::size_t>(static_cast<unsigned char>(head[i])) << (8 * i);
    if (size > kMaxFrame) return fail(ErrorCode::ParseError, "a message of {} bytes", size);
    std::string frame;
    constexpr std::size_t kBlock = std::size_t{1} << 20;  // what is announced may never come
    while (frame.size() < size) {
        const std::size_t have = frame.size();
        frame.resize(std::min(size, have + kBlock));
        if (auto read = reader.read(frame.data() + have, frame.size() - have); !read) return failure(read);
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
