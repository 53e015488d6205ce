#include "core/exchange/Export.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include "core/base/JsonText.h"
#include "core/base/Words.h"
#include "core/session/Digest.h"

namespace tacto {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr Word<ExportContent> kContents[] = {{"streams", ExportContent::Streams}, {"captures", ExportContent::Captures},
                                             {"trials", ExportContent::Trials},   {"trains", ExportContent::Trains},
                                             {"events", ExportContent::Events},   {"records", ExportContent::Records}};

/// Whether the session has anything of this.
bool has(const ExportSource& source, ExportContent content) {
    switch (content) {
        case ExportContent::Streams:
            return !source.streams().empty();
        case ExportContent::Captures:
            return !source.captures().empty();
        case ExportContent::Trials:
            return !source.trialRows().empty();
        case ExportContent::Trains:
            return source.trainCount() > 0;
        case ExportContent::Events:
            return !source.eventRows().empty();
        case ExportContent::Records:
            return true;
    }
    return false;
}

/// Reads the file piece by piece. OpenSSL's SHA-256 uses the processor's own, and libsodium's does not.
Result<ExportedFile> hashedFile(const fs::path& path, const fs::path& relative, const ExportSource& source) {
    std::ifstream in(path, std::ios::binary);
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> hash(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    bool hashed = EVP_DigestInit_ex(hash.get(), EVP_sha256(), nullptr) == 1;
    std::vector<char> piece(std::size_t{1} << 20);
    ExportedFile file{.path = relative.string(), .bytes = 0, .sha256 = {}};
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        const auto got = static_cast<std::size_t>(in.gcount());
        hashed = hashed && EVP_DigestUpdate(hash.get(), piece.data(), got) == 1;
        file.bytes += got;
        if (auto on = source.goOn(); !on) return failure(on);
    }
    if (!in.eof()) return fail(ErrorCode::Io, "{} could not be read back", path.string());
    Digest digest;
    if (!hashed || EVP_DigestFinal_ex(hash.get(), digest.data(), nullptr) != 1)
        return fail(ErrorCode::Unsupported, "this computer's OpenSSL has no SHA-256");
    file.sha256 = hexText(digest);
    return file;
}

/// Lists what was written, by path.
Result<std::vector<ExportedFile>> hashedFiles(const ExportTarget& target, ExportTarget::Kind kind,
                                              const ExportSource& source) {
    std::vector<std::pair<fs::path, fs::path>> paths;
    if (kind == ExportTarget::Kind::File) {
        paths.emplace_back(target.draft(), target.path().filename());
    } else {
        std::error_code error;
        for (fs::recursive_directory_iterator each(target.draft(), error), end; !error && each != end;
             each.increment(error)) {
            if (each->is_regular_file())
                paths.emplace_back(each->path(), each->path().lexically_relative(target.draft()));
        }
        if (error) return fail(ErrorCode::Io, "{} could not be read back: {}", target.path().string(), error.message());
    }
    std::ranges::sort(paths);
    std::vector<ExportedFile> files;
    for (const auto& [path, relative] : paths) {
        auto file = hashedFile(path, relative, source);
        if (!file) return failure(file);
        files.push_back(std::move(*file));
    }
    return files;
}

}  // namespace

std::string_view nameOf(ExportContent content) noexcept { return wordFor(kContents, content); }

void ExportReport::wroteExactly(const ExportStream& stream) {
    ExportedStream written{
        .name = stream.name, .samples = stream.samples, .rate_hz = stream.rate_hz, .gaps = stream.gapCount};
    for (const auto& channel : stream.channels)
        written.channels.push_back({.name = channel.name, .unit = channel.unit, .absent = channel.absent});
    streams.push_back(std::move(written));
}

json toJson(const ExportReport& report) {
    auto files = json::array(), streams = json::array(), leftOut = json::array();
    for (const auto& file : report.files)
        files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
    for (const auto& stream : report.streams) {
        auto channels = json::array();
        for (const auto& channel : stream.channels) {
            channels.push_back({{"name", channel.name},
                                {"unit", channel.unit},
                                {"exact", channel.exact},
                                {"step", numberOrNull(channel.step)},
                                {"max_error", numberOrNull(channel.maxError)},
                                {"absent", channel.absent}});
        }
        streams.push_back({{"name", stream.name},
                           {"samples", stream.samples},
                           {"rate_hz", numberOrNull(stream.rate_hz)},
                           {"gaps", stream.gaps},
                           {"repeated", stream.repeated},
                           {"dropped", stream.dropped},
                           {"time_error_max_s", numberOrNull(stream.maxTimeError_s)},
                           {"channels", channels}});
    }
    for (const auto& each : report.leftOut) leftOut.push_back({{"what", each.what}, {"why", each.why}});
    return {{"format", report.format},
            {"out", report.out.string()},
            {"session", report.session},
            {"chain_head", report.chainHead},
            {"simulated", report.simulated},
            {"marks", report.marks},
            {"files", files},
            {"streams", streams},
            {"left_out", leftOut}};
}

std::vector<LeftOut> leftOutOf(const ExportSource& source, const ExportFormat& format) {
    std::vector<LeftOut> all;
    for (const auto& cannot : format.cannot) {
        if (has(source, cannot.content)) all.push_back({std::string(nameOf(cannot.content)), std::string(cannot.why)});
    }
    return all;
}

Result<ExportReport> exportSession(const fs::path& session, const ExportFormat& format, const fs::path& out,
                                   std::string_view version, const ExportWatch& watch,
                                   std::shared_ptr<const RowSeal> seal, std::string_view code) {
    // Made first: who gave a name that is taken, or a folder that cannot be written to, need not wait.
    auto target = ExportTarget::begin(out, format.kind());
    if (!target) return failure(target);
    const auto source = ExportSource::open(session, std::move(seal), watch, version, code);
    if (!source) return failure(source);
    ExportReport report;
    report.format = format.name;
    report.out = out;
    report.session = session.string();
    report.chainHead = source->chainHead();
    report.simulated = source->simulated();
    report.damaged = source->damaged();
    report.marks = source->marks();
    report.problems = source->problems();
    report.leftOut = leftOutOf(*source, format);
    if (auto written = format.write(*source, target->draft(), report); !written)
        return tl::unexpected(target->named(written.error()));
    auto files = hashedFiles(*target, format.kind(), *source);
    if (!files) return tl::unexpected(target->named(files.error()));
    report.files = std::move(*files);
    if (auto published = target->publish(); !published) return failure(published);
    if (watch.progress) watch.progress(1);
    return report;
}

}  // namespace tacto
