#include "app/gui/sessions/ReadSession.h"

#include "app/gui/theme/Text.h"
#include "app/report/SessionReport.h"
#include "core/base/DriveSegment.h"
#include "core/base/JsonText.h"
#include "core/session/Origin.h"
#include "core/session/SessionIndex.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

/// Report figures come from a script; a figure that cannot be drawn is ignored.
void takeItem(const nlohmann::json& item, const SessionReader& reader, ReadSession& session) {
    const auto kind = textOr(item, "kind");
    if (kind == "about") {
        for (const auto& parameter : valueOr(item, "parameters"))
            session.settings[textOr(parameter, "name")] = parameter;
        return;
    }
    const auto drawn = valueOr(item, "figure");
    if (kind != "figure") return;
    if (textOr(drawn, "type") == "plane") session.planeOfTrials = true;
    if (session.figure || textOr(drawn, "type") == "plane") return;
    auto figure = parseFigure(qtObject(drawn));
    if (!figure || !resolveCaptures(*figure, [&](qint64 id) { return reader.capture(id); })) return;
    session.figure = std::move(*figure);
    session.caption = qtext(textOr(item, "caption"));
}

std::size_t columnOf(const SessionStream& stream, std::string_view name) {
    for (std::size_t c = 0; c < stream.columns.size(); ++c)
        if (stream.columns[c] == name) return c;
    return stream.columns.size();
}

Result<void> readCourse(const SessionReader& reader, ReadSession& session) {
    auto& course = session.course;
    const auto commands = reader.commands();
    if (!commands) return failure(commands);
    for (const auto& row : *commands) {
        if (row.name != "delivered") continue;
        const bool current = !valueOr(row.body, "amplitude_ma").is_null();
        course.unit = amplitudeUnit(current ? Drive::Current : Drive::Voltage);
        course.train_s.push_back(toSeconds(row.at));
        course.amplitude.push_back(numberOr(row.body, current ? "amplitude_ma" : "amplitude_v"));
    }
    for (const auto& info : session.streams) {
        if (info.stream.kind != "frames") continue;
        const auto columns = info.stream.columns.size();
        const auto r = columnOf(info.stream, "R"), p = columnOf(info.stream, "P");
        if (r == columns || p == columns) continue;
        return reader.forEachChunk(info.id, [&](const SampleBlock& block) {
            for (std::size_t i = 0; i < block.samples(); ++i) {
                course.frame_s.push_back(block.t_s[i]);
                course.roughness.push_back(block.values[i * columns + r]);
                course.pressure.push_back(block.values[i * columns + p]);
            }
            return true;
        });
    }
    return {};
}

}  // namespace

Result<ReadSession> readSession(const std::filesystem::path& path) {
    const auto reader = SessionReader::open(path);
    if (!reader) return failure(reader);
    ReadSession session;
    session.path = path;
    session.about = reader->about();
    session.closed = reader->closed();
    session.elsewhere = !session.closed && openElsewhere(path);
    session.head = reader->chainHead();
    session.length = reader->lastAt();
    if (const auto takes = takesLabels(path, *reader); !takes) session.fixed = sentence(takes.error());
    const auto take = [](auto&& from, auto& into) -> Result<void> {
        if (!from) return failure(from);
        into = std::move(*from);
        return {};
    };
    std::vector<SessionRow> items;
    Delivered delivered;
    if (auto done = take(reader->labels(), session.labels); !done) return failure(done);
    if (auto done = take(sessionMarks(*reader), session.marks); !done) return failure(done);
    if (auto done = take(reader->verdicts(), session.verdicts); !done) return failure(done);
    if (auto done = take(reader->trials(), session.trials); !done) return failure(done);
    if (auto done = take(reader->events(), session.events); !done) return failure(done);
    if (auto done = take(reader->log(), session.log); !done) return failure(done);
    if (auto done = take(reader->streams(), session.streams); !done) return failure(done);
    if (auto done = take(reader->captures(), session.captures); !done) return failure(done);
    if (auto done = take(reader->reportItems(), items); !done) return failure(done);
    if (auto done = take(deliveredIn(*reader), delivered); !done) return failure(done);
    session.trains = delivered.trains;
    session.most = delivered.most;
    session.unit = qtext(delivered.unit);
    for (const auto& item : items) takeItem(item.body, *reader, session);
    if (session.figure || session.planeOfTrials) return session;
    if (auto read = readCourse(*reader, session); !read) return failure(read);
    return session;
}

std::vector<PlotMark> operatorMarks(const ReadSession& session) {
    std::vector<PlotMark> marks;
    for (const auto& event : session.events)
        if (event.name == kOperatorMarkEvent) marks.push_back({toSeconds(event.at), textOr(event.body, "text")});
    return marks;
}

}  // namespace tacto::gui
