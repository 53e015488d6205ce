#include "core/session/SessionSummary.h"

#include <algorithm>
#include <limits>

#include "core/base/LockHolder.h"
#include "core/base/RecordFields.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

RecordFields<SessionSummary> buildSummaryFields() {
    using S = SessionSummary;
    constexpr AcceptedText any{.mayBeEmpty = true};
    constexpr auto many = std::numeric_limits<std::size_t>::max();
    RecordFields<S> all;
    all.texts({{"wall_start", &S::wallStart}, {"protocol", &S::protocol}, {"verdict", &S::verdict}}, any);
    all.list("devices", &S::devices, textKind(any), 0, many);
    all.text("operator", in(&S::labels, &SessionLabels::operatorName), any);
    all.text("sample", in(&S::labels, &SessionLabels::sample), any);
    all.text("note", in(&S::labels, &SessionLabels::note), any);
    all.list("tags", in(&S::labels, &SessionLabels::tags), textKind(any), 0, many);
    all.number("duration_s", &S::duration_s);
    all.flag("simulated", &S::simulated);
    all.flag("closed", &S::closed);
    all.flag("faulted", &S::faulted);
    return all;
}

const RecordFields<SessionSummary>& summaryFields() {
    static const auto fields = buildSummaryFields();
    return fields;
}

}  // namespace

Result<SessionSummary> summarise(const std::filesystem::path& session) {
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    const auto verdicts = reader->verdicts();
    if (!verdicts) return failure(verdicts);
    auto labels = reader->labels();
    if (!labels) return failure(labels);
    const auto events = reader->events();
    if (!events) return failure(events);
    const auto& about = reader->about();
    SessionSummary summary;
    summary.wallStart = about.wallStart;
    summary.protocol = about.protocol;
    for (const auto& device : about.devices) summary.devices.push_back(device.name);
    if (!verdicts->empty()) summary.verdict = verdicts->back().verdict;
    summary.labels = std::move(*labels);
    summary.duration_s = toSeconds(reader->lastAt());
    summary.simulated = about.simulated;
    summary.closed = reader->closed();
    summary.faulted = std::ranges::any_of(*events, [](const auto& event) { return event.name == "fault"; });
    return summary;
}

std::string toJsonText(const SessionSummary& summary) { return dumpJson(summaryFields().write(summary)); }

Result<SessionSummary> summaryFrom(std::string_view text) {
    const auto json = parseJson(text, "the summary");
    if (!json) return failure(json);
    auto read = summaryFields().read(*json, RecordPlace{});
    if (!read) return fail(ErrorCode::ParseError, "{}", read.error().message);
    return read;
}

bool openElsewhere(const std::filesystem::path& session) {
    // SQLite holds such a lock on a database with a journal of this kind for as long as it is open.
    return lockHolder(session, "POSIX", LockedBy::Another).has_value();
}

}  // namespace tacto
