// Any file is judged and read without a crash, a hang or a leak, and an intact file can be read (hazard H10). The first
// byte chooses what the rest is: a whole file; changes to an intact session, each with three bytes of position and one
// byte to XOR there; or such changes, with the file cut at the last position.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <unistd.h>
#include <vector>

#include "core/base/Clock.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/session/SessionWriter.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::SessionFuzz {

namespace {

using namespace tacto;
using Bytes = std::vector<char>;

/// Writes a session with a row of every kind and a packed chunk, closed in order.
Bytes soundSession(const std::filesystem::path& path) {
    VirtualClock clock;
    SessionAbout about;
    about.programVersion = "0";
    about.protocol = "fuzz";
    about.wallStart = "2026-11-20T14:03:05Z";
    auto writer = SessionWriter::create(path, about, clock);
    require(writer.has_value());
    auto& session = **writer;
    const auto stream = session.addStream({StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 100, "a"});
    SampleBlock block;
    for (int i = 0; i < 64; ++i) {
        block.t_s.push_back(i * 0.01);
        block.values.insert(block.values.end(), {i * 0.5, -1.0, 0.25});
    }
    require(stream && session.append(*stream, block));
    require(session.trial(clock.now(), "smooth-low", {{"peak_v", 10.5}}).has_value());
    Capture capture;
    capture.rate_hz = 1e6;
    capture.channels.push_back({});
    capture.channels[0].name = "voltage";
    capture.channels[0].samples = {0, 10, 10, 0, -10, -10, 0};
    require(session.capture(clock.now(), capture, 1).has_value());
    require(session.measurement(clock.now(), "impedance", {{"ohm", 1000}}).has_value());
    require(session.verdict(clock.now(), "separability", "accepted", {"all apart"}, {{"p", 0.001}}).has_value());
    require(session.close().has_value());
    writer->reset();
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Bytes changed(Bytes file, std::span<const std::uint8_t> changes, bool cut) {
    std::size_t at = 0;
    for (; changes.size() >= 4; changes = changes.subspan(4)) {
        at = (std::size_t{changes[0]} << 16 | std::size_t{changes[1]} << 8 | changes[2]) % file.size();
        file[at] = static_cast<char>(file[at] ^ static_cast<char>(changes[3]));
    }
    if (cut) file.resize(at);
    return file;
}

void read(const std::filesystem::path& path) {
    const auto judged = verifySession(path);
    const auto reader = SessionReader::open(path);
    require(!judged || judged->status != SessionStatus::Intact || reader.has_value());
    if (!reader) return;
    static_cast<void>(reader->reproducibleText());
    static_cast<void>(reader->trials());
    static_cast<void>(reader->verdicts());
    if (const auto captures = reader->captures()) {
        for (const auto& info : *captures) static_cast<void>(reader->capture(info.seq));
    }
    if (const auto streams = reader->streams()) {
        for (const auto& info : *streams) static_cast<void>(reader->samples(info.id));
    }
}

}  // namespace

TACTO_FUZZ(SessionFuzz, const std::uint8_t* data, std::size_t size) {
    static const auto path =
        std::filesystem::temp_directory_path() / ("tactoscope-fuzz-" + std::to_string(getpid()) + ".tacto");
    static const Bytes sound = soundSession(path);
    if (size == 0) return 0;
    const std::span<const std::uint8_t> rest(data + 1, size - 1);
    const Bytes file = data[0] % 4 == 0 ? Bytes(rest.begin(), rest.end()) : changed(sound, rest, data[0] % 4 == 1);
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(file.data(), static_cast<std::streamsize>(file.size()));
    read(path);
    std::filesystem::remove(path);
    return 0;
}

}  // namespace tacto::fuzz::SessionFuzz
