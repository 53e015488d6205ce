// script_liar, with its seed in TACTO_LIE: replaces tactoscope-script in tests. It arms the bench as a script may, and
// then sends what no script can. Not part of the program.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

namespace {

using nlohmann::json;
constexpr int kSocket = 3;

class Liar {
public:
    explicit Liar(std::uint64_t seed) : random_(seed), kind_(seed % 20) {}

    [[noreturn]] void live() {
        const auto start = read();
        const auto& table = start.at("start").at("functions");
        for (std::size_t i = 0; i < table.size(); ++i)
            names_.push_back(table[i].at("object").get<std::string>() + "." + table[i].at("name").get<std::string>());
        say({{"ready", true}});
        static_cast<void>(read());  // load
        call(".protocol", json::array({{{"title", "Probe"}}, json::array(), json::array()}));
        say({{"ended", nullptr}});
        static_cast<void>(read());  // run
        call("bench.arm", json::array({{{"load", 1000}}}));
        call("bench.drive", json::array({"manual", {{"roughness", 1}, {"pressure", 1}}}));
        call("bench.wait", json::array({0.6}));
        call(".log", json::array({"armed"}));
        lie();
        ::_exit(0);
    }

private:
    void lie() {
        switch (kind_) {
            case 0:
                return raw(std::string(4, '\xff') + "x");  // a frame of 4 GiB
            case 1:
                return frame(noise(1 + random_() % 5000));
            case 2:
                return frame(std::string(2'000'000, '\x81'));  // nested lists
            case 3:
                return say({{"call", -1 - static_cast<std::int64_t>(random_() % 1000)}, {"with", json::array()}});
            case 4:
                return say({{"call", names_.size() + random_() % 5}, {"with", json::array()}, {"line", 1}});
            case 5:
                return say({{"call", index("bench.wait")}, {"with", any(2)}, {"line", any(1)}});
            case 6:
                return say({{"ended", {{"failure", 1'000'000}, {"code", 0}, {"reason", noise(3'000'000)}}}});
            case 7:
                ::_exit(static_cast<int>(random_() % 256));
            case 8:
                return raw(std::string("\x10\0\0\0", 4) + "\xa1");  // part of a frame, then the connection ends
            case 9:
                return say({{"refused", index("bench.arm")}, {"why", any(3)}}), say({{"ended", 5}});
            case 10:
                static_cast<void>(std::raise(SIGSEGV));
                return;
            case 11:
                return frame(
                    std::string("\xa2\x65"
                                "ended\xf6\x65"
                                "ended\xf6",
                                15));  // a repeated key
            case 12:
                return flood();
            case 13:
                return frame(std::string(150'000, '\x7f'));  // nested texts without an end
            case 14:
                ::close(kSocket);
                return linger();
            case 15:  // one byte now and then
                raw(std::string("\x40\0\0\0", 4));
                for (int i = 0; i < 60; ++i) {
                    raw("x");
                    ::usleep(50'000);
                }
                return;
            case 16:  // reads no answer
                for (int i = 0; i < 20'000; ++i)
                    say({{"call", index("bench.time")}, {"with", json::array()}, {"line", 2}});
                return linger();
            case 17:
                return say({{"ended", {{"memory", true}, {"reason", "stopped by operator (signal)"}}}});
            case 18:  // a process that stays behind keeps the socket open
                if (::fork() == 0) linger();
                return;
            default:
                say({{"ended", {{"reason", 5}, {"line", std::numeric_limits<std::int64_t>::max()}}}});
        }
    }
    static void linger() {
        ::sleep(3);
        ::_exit(0);
    }
    /// Makes calls that fit no function, then exits.
    void flood() {
        for (int i = 0; i < 300; ++i) {
            const auto name = names_[random_() % names_.size()];
            if (name == "bench.wait" || name == ".verdict" || name.starts_with("operator.")) continue;
            json given = json::array();
            for (std::size_t k = random_() % 4; k > 0; --k) given.push_back(any(3));
            call(name, given);
        }
        ::_exit(1);
    }

    json any(int depth) {
        switch (random_() % (depth > 0 ? 9 : 7)) {
            case 0:
                return nullptr;
            case 1:
                return std::numeric_limits<double>::quiet_NaN();
            case 2:
                return std::numeric_limits<double>::infinity();
            case 3:
                return static_cast<std::int64_t>(random_());
            case 4:
                return noise(random_() % 40);
            case 5:
                return -1e308;
            case 6:
                return true;
            case 7: {
                json list = json::array();
                for (std::size_t k = random_() % 5; k > 0; --k) list.push_back(any(depth - 1));
                return list;
            }
            default: {
                json object = json::object();
                for (const char* key : {"load", "capture", "roughness", "options", "captures"})
                    if (random_() % 2 == 0) object[key] = any(depth - 1);
                return object;
            }
        }
    }
    std::string noise(std::size_t size) {
        std::string out(size, '\0');
        for (auto& c : out) c = static_cast<char>(random_());
        return out;
    }
    [[nodiscard]] std::size_t index(const std::string& name) const {
        for (std::size_t i = 0; i < names_.size(); ++i)
            if (names_[i] == name) return i;
        ::_exit(9);
    }
    void call(const std::string& name, const json& given) {
        say({{"call", index(name)}, {"with", given}, {"line", 2}});
        static_cast<void>(read());
    }
    static void say(const json& message) {
        std::string bytes;
        json::to_cbor(message, bytes);
        frame(bytes);
    }
    static void frame(const std::string& bytes) {
        std::string head;
        for (unsigned i = 0; i < 4; ++i) head += static_cast<char>(bytes.size() >> (8 * i) & 0xFFU);
        raw(head + bytes);
    }
    static void raw(const std::string& bytes) {
        for (std::size_t at = 0; at < bytes.size();) {
            const auto n = ::send(kSocket, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
            if (n <= 0) ::_exit(8);
            at += static_cast<std::size_t>(n);
        }
    }
    static json read() {
        std::string head(4, '\0');
        fill(head);
        std::size_t size = 0;
        for (unsigned i = 0; i < 4; ++i)
            size |= static_cast<std::size_t>(static_cast<unsigned char>(head[i])) << (8 * i);
        std::string bytes(size, '\0');
        fill(bytes);
        return json::from_cbor(bytes);
    }
    static void fill(std::string& bytes) {
        for (std::size_t at = 0; at < bytes.size();) {
            const auto n = ::recv(kSocket, bytes.data() + at, bytes.size() - at, 0);
            if (n <= 0) ::_exit(7);
            at += static_cast<std::size_t>(n);
        }
    }

    std::mt19937_64 random_;
    std::uint64_t kind_;
    std::vector<std::string> names_;
};

}  // namespace

int main() {
    const char* seed = std::getenv("TACTO_LIE");  // a script's process gets no arguments
    Liar(seed != nullptr ? std::strtoull(seed, nullptr, 10) : 0).live();
}
