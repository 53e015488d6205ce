#include "core/session/SealedRow.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/JsonText.h"
#include "core/base/Printable.h"
#include "core/session/Schema.h"
#include "core/session/SessionTypes.h"

namespace tacto {

namespace {

using Keys = std::span<const std::string_view>;

/// The members that rows of a kind show; events with certain names have rules of their own.
struct ShownOfKind {
    std::string_view kind;
    bool name;
    Keys keys;
};
constexpr std::string_view kAboutKeys[] = {
    "program_version", "protocol", "protocol_sha256", "devices",      "limit_sets",
    "simulated",       "mode",     "wall_start",      "virtual_clock"};
constexpr std::string_view kTrialKeys[] = {"number"};
constexpr std::string_view kChunkKeys[] = {"stream", "index"};
constexpr std::string_view kCaptureKeys[] = {"trial"};
constexpr ShownOfKind kShownOfKinds[] = {{kind::kAbout, true, kAboutKeys},
                                         {kind::kTrial, false, kTrialKeys},
                                         {kind::kChunk, true, kChunkKeys},
                                         {kind::kCapture, true, kCaptureKeys},
                                         {kind::kLog, true, {}}};

struct ShownOfEvent {
    std::string_view name;
    Keys keys;  ///< values that are texts are shown without their numbers
    bool whole = false;
};
constexpr std::string_view kTextKeys[] = {"text"};
constexpr std::string_view kArmingKeys[] = {"limits", "calibrated", "mode"};
constexpr ShownOfEvent kShownOfEvents[] = {
    {"interlock", kTextKeys},
    {"fault", kTextKeys},
    {"refused", kTextKeys},
    {"stale", kTextKeys},
    {kMeasuredBeyondEvent, kTextKeys},
    {"arming", kArmingKeys},
    {"calibration", {}, true},
    {kCertificateEvent, {}, true},
    {kMarksEvent, {}, true},
    {kMarkEvent, {}, true},
    // These names show the progress of the session; the bodies are sealed.
    {kOperatorMarkEvent, {}},
    {"device report", {}},
    {"keep-alive", {}},
    {"settings", {}},
    {"ledger", {}, true},
    {"plan", {}},
    {"gate", {}},
    {"stop-test", {}},
    {"skin", {}},
    {"impedance", {}},
    {"phase", {}},
    {"trial-begin", {}},
    {"answer", {}},
    {"no-answer", {}},
    {"answer-early", {}},
    {"estimate", {}},
    {"range", {}},
    {"drift", {}},
    {"break-begin", {}},
    {"break-end", {}},
    {"focus-lost", {}},
    {"participant-stop", {}},
    {"operator-stop", {}},
    {"pause", {}},
    {"continue", {}},
    {"resumed", {}},
    {"rating", {}},
    {"side-effect", {}},
    {"note", {}},
    {"adverse-event", {}},
    {"session-end", {}},
};

constexpr const char* kSealedKey = "sealed";
constexpr const char* kSealedName = "sealed";

nlohmann::json shownKeys(const nlohmann::json& body, Keys keys, bool hideNumbers) {
    auto shown = nlohmann::json::object();
    for (const auto key : keys) {
        const auto found = body.find(key);
        if (found == body.end()) continue;
        shown[std::string(key)] = hideNumbers && found->is_string()
                                      ? nlohmann::json(withoutNumbers(found->get_ref<const std::string&>()))
                                      : *found;
    }
    return shown;
}

struct Shown {
    bool name = false;
    nlohmann::json body = nlohmann::json::object();
};

Shown shownOf(std::string_view kind, std::string_view name, std::string_view body) {
    const auto whole = [&] {
        auto read = parseJson(body, "a row", kRowLimits);
        return read && read->is_object() ? *std::move(read) : nlohmann::json::object();
    };
    if (kind == kind::kEvent) {
        const auto* rule = std::ranges::find(kShownOfEvents, name, &ShownOfEvent::name);
        if (rule == std::end(kShownOfEvents)) return {};
        if (rule->whole) return {true, whole()};
        return {true, rule->keys.empty() ? nlohmann::json::object() : shownKeys(whole(), rule->keys, true)};
    }
    const auto* rule = std::ranges::find(kShownOfKinds, kind, &ShownOfKind::kind);
    if (rule == std::end(kShownOfKinds)) return {};
    return {rule->name, rule->keys.empty() ? nlohmann::json::object() : shownKeys(whole(), rule->keys, false)};
}

std::string bulkKind(std::string_view kind) { return fmt::format("{} bytes", kind); }

}  // namespace

bool isSealedKind(std::string_view kind) noexcept {
    return kind != kind::kStream && kind != kind::kEnd && kind != kind::kAnnotation;
}

Instant wholeSecond(Instant at) noexcept { return std::chrono::floor<std::chrono::seconds>(at); }

OutsideRow sealedRow(const RowSeal& seal, std::int64_t seq, std::string_view kind, Instant at, std::string_view name,
                     std::string_view body) {
    if (!isSealedKind(kind)) return {wholeSecond(at), std::string(name), std::string(body)};
    auto shown = shownOf(kind, name, body);
    const auto inside =
        fmt::format("{{\"t_ns\":{},\"name\":{},\"body\":{}}}", at.count(), dumpJson(nlohmann::json(name)), body);
    shown.body[kSealedKey] = seal.sealText(seq, kind, inside);
    return {wholeSecond(at), shown.name ? std::string(name) : std::string(), dumpJson(shown.body)};
}

Result<InsideRow> openedRow(const RowSeal* seal, std::int64_t seq, std::string_view kind, Instant at,
                            std::string_view name, nlohmann::json body) {
    if (!isSealedKind(kind)) return InsideRow{at, std::string(name), std::move(body), false};
    if (seal == nullptr) {
        const bool nameIsShown = kind == kind::kEvent ? !name.empty() : shownOf(kind, name, "{}").name;
        if (body.is_object()) body[kSealedKey] = true;
        return InsideRow{at, nameIsShown ? std::string(name) : kSealedName, std::move(body), true};
    }
    const auto text = seal->openText(seq, kind, textOr(body, kSealedKey));
    if (!text) return fail(ErrorCode::ParseError, "row {} of the session: {}", seq, text.error().message);
    auto inside = parseJson(*text, fmt::format("row {} of the session", seq), kRowLimits);
    if (!inside) return failure(inside);
    const auto exact = valueOr(*inside, "t_ns");
    if (!exact.is_number_integer() || wholeSecond(Instant(exact.get<std::int64_t>())) != at)
        return fail(ErrorCode::ParseError, "row {} of the session states another time inside than outside", seq);
    if (!name.empty() && textOr(*inside, "name") != name)
        return fail(ErrorCode::ParseError, "row {} of the session states another name inside than outside", seq);
    return InsideRow{Instant(exact.get<std::int64_t>()), textOr(*inside, "name"), valueOr(*inside, "body"), false};
}

std::vector<std::byte> sealedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                  std::span<const std::span<const std::byte>> parts) {
    return seal.sealBytes(seq, bulkKind(kind), parts);
}

Result<std::vector<std::byte>> openedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                          std::span<const std::byte> sealed) {
    auto opened = seal.openBytes(seq, bulkKind(kind), sealed);
    if (!opened) return fail(ErrorCode::ParseError, "the samples of row {}: {}", seq, opened.error().message);
    return opened;
}

Result<void> unpackOpenedChunk(const ChunkHead& head, std::size_t columns, std::span<const std::byte> opened,
                               SampleBlock& into) {
    const std::size_t stamps = head.line ? 0 : head.samples * sizeof(double);
    if (stamps > opened.size()) {
        return fail(ErrorCode::ParseError, "chunk {} of stream {} holds {} bytes, not {} time stamps", head.index,
                    head.stream, opened.size(), head.samples);
    }
    return unpackChunk(head, columns, opened.first(stamps), opened.subspan(stamps), into);
}

}  // namespace tacto
