#include "tests/drivers/sensor_board/BoardOnPty.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

namespace tacto::test {

BoardOnPty::BoardOnPty(const Clock& clock, sensorboard::EmulatedBoardSettings settings, BoardFeed::MakeSignal signal) {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::array<char, 64> name{};
    if (master_ < 0 || wake_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
        ptsname_r(master_, name.data(), name.size()) != 0) {
        throw std::runtime_error("the system gives no pseudo-terminal");
    }
    path_ = name.data();
    slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    if (slave_ < 0 || tcgetattr(slave_, &raw) != 0) throw std::runtime_error(path_ + " cannot be opened");
    cfmakeraw(&raw);  // else what a client sends before it has set up the terminal comes back as an echo
    tcsetattr(slave_, TCSANOW, &raw);
    // As on USB, where the host fetches: the board waits, and keeps meanwhile what fits into its buffer. Bytes not
    // fetched within a second are lost.
    const auto send = [master = master_](std::span<const std::uint8_t> bytes) {
        while (!bytes.empty()) {
            const auto written = ::write(master, bytes.data(), bytes.size());
            if (written < 0 && errno != EAGAIN && errno != EINTR) return;
            if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
            pollfd room{master, POLLOUT, 0};
            if (!bytes.empty() && poll(&room, 1, 1000) == 0) return;
        }
    };
    feed_ = std::make_unique<BoardFeed>(clock, std::move(settings), send, std::move(signal));
    listener_ = std::thread([this] { listen(); });
}

BoardOnPty::~BoardOnPty() {
    const std::uint64_t one = 1;
    static_cast<void>(!::write(wake_, &one, sizeof one));
    listener_.join();
    feed_.reset();
    for (const int end : {master_, slave_, wake_}) ::close(end);
}

void BoardOnPty::listen() {
    std::array<std::uint8_t, 1024> bytes{};
    for (;;) {
        pollfd look[] = {{master_, POLLIN, 0}, {wake_, POLLIN, 0}};
        if (poll(look, 2, -1) < 0 && errno != EINTR) return;
        if ((look[1].revents & POLLIN) != 0) return;
        const auto got = ::read(master_, bytes.data(), bytes.size());
        if (got > 0) feed_->receive(std::span<const std::uint8_t>(bytes).first(static_cast<std::size_t>(got)));
    }
}

}  // namespace tacto::test
