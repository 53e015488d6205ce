#include "core/session/SessionSignature.h"

#include <algorithm>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/Words.h"
#include "core/session/Database.h"
#include "core/session/Digest.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionSource.h"

namespace tacto {

namespace {

constexpr std::uintmax_t kMaxReport_bytes = 1'000'000'000;

constexpr Word<SignedReport> kSignedReportWords[] = {{"unchanged", SignedReport::Unchanged},
                                                     {"changed", SignedReport::Changed},
                                                     {"signed again", SignedReport::SignedAgain},
                                                     {"missing", SignedReport::Missing}};

Result<std::string> hashOf(const std::filesystem::path& report) {
    const auto bytes = readTextFile(report, kMaxReport_bytes);
    if (!bytes) return failure(bytes);
    return sha256Hex(*bytes);
}

/// Returns the file's name if it lies beside the session, so that both can be moved together. Other paths could name a
/// participant, so a sealed session keeps only a name that is its own.
std::string placeOf(const std::filesystem::path& session, const std::filesystem::path& report, bool sealed) {
    const auto whole = std::filesystem::absolute(report).lexically_normal();
    const auto own = std::filesystem::absolute(session).lexically_normal();
    const bool beside = whole.parent_path() == own.parent_path();
    if (sealed && (!beside || whole.stem() != own.stem())) return {};
    return beside ? whole.filename().string() : whole.string();
}

}  // namespace

std::string_view nameOf(SignedReport state) noexcept { return wordFor(kSignedReportWords, state); }

std::optional<SessionSignature> signatureIn(const nlohmann::json& body) {
    const auto row = valueOr(body, "signed");
    if (!row.is_object()) return std::nullopt;
    return SessionSignature{textOr(row, "by"), textOr(body, "wall"), textOr(row, "report"), textOr(row, "sha256")};
}

Result<SessionSignature> signReport(const std::filesystem::path& session, const std::filesystem::path& report,
                                    const std::string& by) {
    SessionLabels asLabel;
    asLabel.operatorName = by;
    if (by.find_first_not_of(' ') == std::string::npos || !checkLabels(asLabel)) {
        return invalid("the name of who signs is \"{}\"; one line of 1 to {} characters is expected", printable(by),
                       kLabelLimit);
    }
    const auto hash = hashOf(report);
    if (!hash) return failure(hash);
    SessionSignature signature{by, {}, {}, *hash};
    const auto added = annotateSession(session, [&](const SessionReader& reader) -> Result<nlohmann::json> {
        signature.report = placeOf(session, report, reader.sealed());
        return nlohmann::json{
            {"signed", {{"by", signature.by}, {"report", signature.report}, {"sha256", signature.sha256}}}};
    });
    if (!added) return failure(added);
    const auto all = signaturesIn(session);
    if (!all) return failure(all);
    if (!all->empty()) signature = all->back();
    return signature;
}

Result<std::vector<SessionSignature>> signaturesIn(const std::filesystem::path& session) {
    const auto source = SessionSource::open(session);
    if (!source) return failure(source);
    auto rows = source->database().prepare("SELECT body FROM entries WHERE kind='annotation' ORDER BY seq");
    if (!rows) return failure(rows);
    std::vector<SessionSignature> signatures;
    for (;;) {
        auto more = rows->step();
        if (!more) return failure(more);
        if (!*more) return signatures;
        const auto body = parseJson(rows->text(0), "an annotation", kRowLimits);
        if (!body) return failure(body);
        if (auto signature = signatureIn(*body)) signatures.push_back(std::move(*signature));
    }
}

std::vector<CheckedSignature> checkSignatures(const std::filesystem::path& session,
                                              const std::vector<SessionSignature>& signatures) {
    std::vector<CheckedSignature> checked;
    for (auto each = signatures.begin(); each != signatures.end(); ++each) {
        const auto hash = hashOf(session.parent_path() / each->report);
        const bool again = std::any_of(std::next(each), signatures.end(),
                                       [&](const auto& later) { return later.report == each->report; });
        const auto state = !hash                   ? SignedReport::Missing
                           : *hash == each->sha256 ? SignedReport::Unchanged
                           : again                 ? SignedReport::SignedAgain
                                                   : SignedReport::Changed;
        checked.push_back({*each, state});
    }
    return checked;
}

std::string sentenceOf(const CheckedSignature& signature) {
    const auto& [signed_, state] = signature;
    const auto said = fmt::format("{} signed {} at {}", signed_.by,
                                  signed_.report.empty() ? "a report" : signed_.report, signed_.wall);
    switch (state) {
        case SignedReport::Unchanged:
            return said + "; it is unchanged since.";
        case SignedReport::Changed:
            return fmt::format("{}, and it was changed after that: its SHA-256 was {}.", said, signed_.sha256);
        case SignedReport::SignedAgain:
            return said + "; it was changed and signed again later.";
        case SignedReport::Missing:
            break;
    }
    return fmt::format("{}; it is {} to be checked: its SHA-256 was {}.", said,
                       signed_.report.empty() ? "kept elsewhere, where a sealed session does not look" : "not there",
                       signed_.sha256);
}

}  // namespace tacto
