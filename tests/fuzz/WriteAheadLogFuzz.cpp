// The log of a session that a crash cut off, with any bytes changed: judged and read without a crash or a hang (hazard
// H10), and never with more rows than were written. The input is a list of changes, each with three bytes of position
// and one byte to XOR there; if the first byte is odd, the log is cut at the last position.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/base/Clock.h"
#include "core/session/Database.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/session/SessionWriter.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::WriteAheadLogFuzz {

namespace {

using namespace tacto;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kTrials = 4;

Bytes bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct CutOff {
    Bytes session;
    Bytes log;
};

/// Makes a session and its log as a killed program leaves them.
CutOff cutOffSession() {
    const auto path = fuzz::scratchFolder() / "whole.tacto";
    VirtualClock clock;
    SessionAbout about;
    about.programVersion = "0";
    about.protocol = "fuzz";
    about.wallStart = "2026-11-20T14:03:05Z";
    auto writer = SessionWriter::create(path, about, clock);
    require(writer.has_value());
    for (std::size_t i = 0; i < kTrials; ++i) {
        require((*writer)->trial(clock.now(), "smooth-low", {{"peak_v", 10.5}}).has_value());
    }
    CutOff left{bytesOf(path), bytesOf(path.string() + "-wal")};
    require(left.log.size() > 32);
    return left;
}

}  // namespace

TACTO_FUZZ(WriteAheadLogFuzz, const std::uint8_t* data, std::size_t size) {
    static const CutOff sound = cutOffSession();
    auto log = sound.log;
    std::size_t at = log.size();
    for (std::size_t i = 1; i + 4 <= size; i += 4) {
        at = (std::size_t{data[i]} << 16 | std::size_t{data[i + 1]} << 8 | data[i + 2]) % log.size();
        log[at] ^= data[i + 3];
    }
    if (size > 0 && data[0] % 2 == 1) log.resize(at);
    const auto path = fuzz::inputFile("cut.tacto", sound.session);
    const auto wal = fuzz::inputFile("cut.tacto-wal", log);
    std::filesystem::remove(path.string() + "-shm");

    const auto found = scanWal(wal);
    require(found.has_value() || !found.error().message.empty());
    const auto judged = verifySession(path);
    require(judged.has_value() || !judged.error().message.empty());
    const auto reader = SessionReader::open(path);
    require(!judged || judged->status != SessionStatus::Intact || reader.has_value());
    if (!reader) return 0;
    if (const auto trials = reader->trials()) require(trials->size() <= kTrials);
    static_cast<void>(reader->reproducibleText());
    return 0;
}

}  // namespace tacto::fuzz::WriteAheadLogFuzz
