#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "drivers/sigrok/transport/TcpRelay.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using sigrok_driver::TcpRelay;

/// Closes its socket when destroyed.
class Socket {
public:
    explicit Socket(int number) : number_(number) {}
    ~Socket() { close(); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    operator int() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

class RelayTest : public testing::Test {
protected:
    void SetUp() override {
        auto address = loopback(0);
        socklen_t size = sizeof address;
        ASSERT_EQ(::bind(listener_, generic(address), size), 0);
        ASSERT_EQ(::listen(listener_, 4), 0);
        ASSERT_EQ(::getsockname(listener_, generic(address), &size), 0);
        port_ = ntohs(address.sin_port);
    }
    static void connect(int socket, std::uint16_t port) {
        auto address = loopback(port);
        ASSERT_EQ(::connect(socket, generic(address), sizeof address), 0);
    }
    static std::string receive(int socket, std::size_t count) {
        std::string text(count, '\0');
        std::size_t got = 0;
        while (got < count) {
            const auto part = ::recv(socket, text.data() + got, count - got, 0);
            if (part <= 0) break;
            got += static_cast<std::size_t>(part);
        }
        text.resize(got);
        return text;
    }

    Socket listener_{::socket(AF_INET, SOCK_STREAM, 0)};
    std::uint16_t port_ = 0;
};

TEST_F(RelayTest, PassesBothWaysAndConnectsAnewForTheNextConversation) {
    auto relay = accepted(TcpRelay::start("127.0.0.1", std::to_string(port_)));
    for (int i = 0; i < 3; ++i) {
        Socket client(::socket(AF_INET, SOCK_STREAM, 0));
        connect(client, relay->port());
        const Socket instrument(::accept(listener_, nullptr, nullptr));
        ASSERT_GE(instrument, 0);
        ASSERT_EQ(::send(client, "*IDN?\r\n", 7, 0), 7);
        EXPECT_EQ(receive(instrument, 7), "*IDN?\r\n");
        const std::string large(3'000'000, 'x');
        std::thread sender([&] {
            std::size_t sent = 0;
            while (sent < large.size()) {
                const auto part = ::send(instrument, large.data() + sent, large.size() - sent, MSG_NOSIGNAL);
                if (part <= 0) break;
                sent += static_cast<std::size_t>(part);
            }
        });
        EXPECT_EQ(receive(client, large.size()), large);
        sender.join();
        client.close();  // libsigrok, not the instrument, ends conversations
        EXPECT_EQ(receive(instrument, 1), "");
        EXPECT_FALSE(relay->fault().has_value());
        EXPECT_LT(relay->silence().count(), 60);
    }
}

TEST_F(RelayTest, AnInstrumentThatHangsUpEndsTheReadAndIsNamed) {
    auto relay = accepted(TcpRelay::start("127.0.0.1", std::to_string(port_)));
    const Socket client(::socket(AF_INET, SOCK_STREAM, 0));
    connect(client, relay->port());
    {
        const Socket instrument(::accept(listener_, nullptr, nullptr));
        ASSERT_EQ(::send(client, "x", 1, 0), 1);
        EXPECT_EQ(receive(instrument, 1), "x");
    }
    char byte = 0;
    EXPECT_LE(::recv(client, &byte, 1, 0), 0);
    const auto fault = accepted(relay->fault());
    EXPECT_EQ(fault.code, ErrorCode::Device);
    EXPECT_THAT(fault.message, testing::HasSubstr("hung up"));
}

TEST_F(RelayTest, CuttingEndsAReadThatWaits) {
    auto relay = accepted(TcpRelay::start("127.0.0.1", std::to_string(port_)));
    const Socket client(::socket(AF_INET, SOCK_STREAM, 0));
    connect(client, relay->port());
    const Socket instrument(::accept(listener_, nullptr, nullptr));
    std::thread reader([&] {
        char byte = 0;
        EXPECT_LE(::recv(client, &byte, 1, 0), 0);
    });
    relay->cut();
    reader.join();
}

TEST_F(RelayTest, AConnectionOfAnotherProcessIsClosedAndNothingOfItReachesTheInstrument) {
    RecordProperty("hazard", "H10");
    auto relay = accepted(TcpRelay::start("127.0.0.1", std::to_string(port_)));
    const Socket instrument(::accept(listener_, nullptr, nullptr));
    auto address = loopback(relay->port());
    const pid_t other = fork();
    if (other == 0) {  // only system calls here, because this process has threads
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        if (::connect(socket, generic(address), sizeof address) != 0) _exit(2);
        static_cast<void>(::send(socket, "*RST\r\n", 6, MSG_NOSIGNAL));
        char byte = 0;
        _exit(::recv(socket, &byte, 1, 0) <= 0 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(other, &status, 0), other);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0) << "it was not hung up on";
    // The relay serves its own client afterwards, and that client's bytes are the first to arrive.
    const Socket client(::socket(AF_INET, SOCK_STREAM, 0));
    connect(client, relay->port());
    ASSERT_EQ(::send(client, "*IDN?\r\n", 7, 0), 7);
    EXPECT_EQ(receive(instrument, 7), "*IDN?\r\n");
}

TEST(Relay, RefusedAndUnknownHostsAreNotFound) {
    EXPECT_THAT(TcpRelay::start("127.0.0.1", "1"), refused(ErrorCode::NotFound, "127.0.0.1:1"));
    EXPECT_EQ(TcpRelay::start("127.0.0.1", "no-such-service").error().code, ErrorCode::NotFound);
}

TEST(Relay, AHostThatDoesNotAnswerIsATimeoutOrUnreachableButSoon) {
    // 192.0.2.0/24 is reserved for documentation, so no host answers. Without a network the connection fails at once.
    const auto since = std::chrono::steady_clock::now();
    EXPECT_FALSE(TcpRelay::start("192.0.2.1", "5555", Seconds(0.3)).has_value());
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - since < std::chrono::seconds(3));
}

}  // namespace
}  // namespace tacto::test
