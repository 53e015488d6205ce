#include "app/gui/sessions/ReadSession.h"

#include <cmath>
#include <map>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"
#include "app/report/ResultCells.h"
#include "app/report/SessionReport.h"
#include "core/base/DriveSegment.h"
#include "core/base/JsonText.h"
#include "core/session/Origin.h"
#include "core/session/SessionIndex.h"
#include "core/session/SessionLabels.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

std::size_t columnOf(const SessionStream& stream, std::string_view name) {
    for (std::size_t c = 0; c < stream.columns.size(); ++c)
        if (stream.columns[c] == name) return c;
    return stream.columns.size();
}

constexpr std::size_t kMaxTrains = 10'000;
constexpr std::uint64_t kMaxFrameValues = 1'000'000;

bool byCurrent(const SessionRow& train) { return !valueOr(train.body, "amplitude_ma").is_null(); }
double amplitudeOf(const SessionRow& train) {
    return numberOr(train.body, byCurrent(train) ? "amplitude_ma" : "amplitude_v");
}

/// Collects trains; of too many, the largest of each few.
class TrainCourse {
public:
    explicit TrainCourse(SessionCourse& course) : course_(course) {}
    void add(const SessionRow& train) {
        course_.unit = amplitudeUnit(byCurrent(train) ? Drive::Current : Drive::Voltage);
        const double amplitude = amplitudeOf(train);
        auto& all = course_.amplitude;
        if (count_++ % course_.perTrain == 0) {
            if (all.size() == kMaxTrains) halve();
            course_.train_s.push_back(toSeconds(train.at));
            all.push_back(amplitude);
        } else if (!(amplitude <= all.back())) {
            course_.train_s.back() = toSeconds(train.at);
            all.back() = amplitude;
        }
    }

private:
    void halve() {
        auto& all = course_.amplitude;
        for (std::size_t i = 0; i < all.size() / 2; ++i) {
            const auto larger = 2 * i + (all[2 * i + 1] > all[2 * i] ? 1 : 0);
            all[i] = all[larger];
            course_.train_s[i] = course_.train_s[larger];
        }
        all.resize(all.size() / 2);
        course_.train_s.resize(all.size());
        course_.perTrain *= 2;
    }
    SessionCourse& course_;
    std::size_t count_ = 0;
};

Result<void> readFrames(const SessionReader& reader, ReadSession& session) {
    auto& course = session.course;
    for (const auto& info : session.streams) {
        if (info.stream.kind != "frames") continue;
        const auto columns = info.stream.columns.size();
        const auto r = columnOf(info.stream, "R"), p = columnOf(info.stream, "P");
        if (r == columns || p == columns) continue;
        auto read = reader.outline(info.id, kMaxFrameValues);
        if (!read) return failure(read);
        const auto& frames = read->samples;
        course.oneIn = read->oneIn;
        for (std::size_t i = 0; i < frames.samples(); ++i) {
            course.roughness.push_back(frames.values[i * columns + r]);
            course.pressure.push_back(frames.values[i * columns + p]);
        }
        course.frame_s = std::move(read->samples.t_s);
        return {};
    }
    return {};
}

constexpr int kShownDigits = 4;

/// The commands delivered for one capture: their least and largest values.
struct CommandRange {
    double low = kNaN, high = kNaN;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] QString text(const QString& unit) const {
        if (!std::isfinite(low)) return {};
        // A calibration commands 499.999 ms for 500 ms.
        const auto set = [](double value) { return QString::number(value, 'g', kShownDigits).toDouble(); };
        const auto most = settingText(set(high), unit);
        return set(low) == set(high) ? most : QObject::tr("%1 to %2").arg(settingText(set(low), {}), most);
    }
};

/// Finds the command of each capture: the last train delivered before it, or all those of its trial.
Result<void> readCommands(const SessionReader& reader, ReadSession& session) {
    struct Command {
        std::int64_t seq = 0;
        double amplitude = kNaN, interval_s = kNaN, impedance_ohm = kNaN;
        bool current = false;
    };
    std::vector<Command> delivered;  // since the capture before
    std::map<int, const SessionTrial*> trials;
    for (const auto& trial : session.trials) trials[trial.number] = &trial;
    const double set = numberOr(session.about.parameters, "load");
    auto next = session.captures.begin();
    const auto close = [&](ReadCapture& capture) {
        const auto* before = &capture == session.captures.data() ? nullptr : &capture - 1;
        const auto found = capture.trial ? trials.find(*capture.trial) : trials.end();
        const auto* trial = found != trials.end() ? found->second : nullptr;
        if (before != nullptr && delivered.empty() && before->trial == capture.trial) {
            capture.load = before->load;
            capture.command = before->command;
            return;
        }
        if (trial == nullptr && delivered.size() > 1) delivered.erase(delivered.begin(), delivered.end() - 1);
        CommandRange amplitude, interval;
        for (const auto& command : delivered) {
            amplitude.include(command.amplitude);
            interval.include(command.interval_s);
        }
        const bool current = !delivered.empty() && delivered.back().current;
        const auto every = interval.text("s");
        capture.command = amplitude.text(amplitudeUnit(current ? Drive::Current : Drive::Voltage));
        if (!capture.command.isEmpty() && !every.isEmpty())
            capture.command = QObject::tr("%1 every %2").arg(capture.command, every);
        // A trial into one of several loads is named by its load and command: "1 kohm, 10.0 V".
        if (trial != nullptr && trial->measured.contains("command_v"))
            capture.load = loadText(qtext(trial->condition.substr(0, trial->condition.rfind(", "))));
        else if (std::isfinite(set))
            capture.load = settingText(set, "ohm");
        else if (!delivered.empty() && std::isfinite(delivered.back().impedance_ohm))
            capture.load = QObject::tr("%1, measured").arg(quantityText(delivered.back().impedance_ohm, "ohm", 3));
        delivered.clear();
    };
    const auto take = [&](const SessionRow& row) {
        for (; next != session.captures.end() && next->seq < row.seq; ++next) close(*next);
        if (next == session.captures.end()) return;
        delivered.push_back({row.seq, amplitudeOf(row), numberOr(row.body, "interval_s"),
                             numberOr(row.body, "impedance_ohm"), byCurrent(row)});
    };
    auto read = reader.forEachCommand(take, [](std::string_view name) { return name == "delivered"; });
    for (; next != session.captures.end(); ++next) close(*next);
    return read;
}

}  // namespace

Result<ReadSession> readSession(const std::filesystem::path& path) {
    const auto reader = SessionReader::open(path);
    if (!reader) return failure(reader);
    ReadSession session;
    TrainCourse trains(session.course);
    auto compared = readForComparison(*reader, [&](const SessionRow& train) { trains.add(train); });
    if (!compared) return failure(compared);
    static_cast<ComparedSession&>(session) = std::move(*compared);
    session.path = path;
    session.elsewhere = !session.closed && openElsewhere(path);
    session.head = reader->chainHead();
    if (const auto takes = takesLabels(path, *reader); !takes) session.fixed = sentence(takes.error());
    const auto take = [](auto&& from, auto& into) -> Result<void> {
        if (!from) return failure(from);
        into = std::move(*from);
        return {};
    };
    std::vector<SessionRow> items;
    const auto signatures = signaturesIn(path);
    if (!signatures) return failure(signatures);
    session.signatures = checkSignatures(path, *signatures);
    if (auto done = take(sessionMarks(*reader, session.delivered), session.marks); !done) return failure(done);
    if (auto done = take(reader->events(), session.events); !done) return failure(done);
    if (auto done = take(reader->log(), session.log); !done) return failure(done);
    if (auto done = take(reader->streams(), session.streams); !done) return failure(done);
    std::vector<SessionCaptureInfo> captures;
    if (auto done = take(reader->captures(), captures); !done) return failure(done);
    for (auto& capture : captures) session.captures.push_back({std::move(capture), {}, {}});
    if (!captures.empty())
        if (auto done = readCommands(*reader, session); !done) return failure(done);
    if (auto done = take(reader->reportItems(), items); !done) return failure(done);
    static_cast<SessionFigure&>(session) = figureIn(items, *reader);
    if (session.figure || session.planeOfTrials)
        session.course = {};
    else if (auto read = readFrames(*reader, session); !read)
        return failure(read);
    return session;
}

std::vector<PlotMark> operatorMarks(const ReadSession& session) {
    std::vector<PlotMark> marks;
    for (const auto& event : session.events)
        if (event.name == kOperatorMarkEvent) marks.push_back({toSeconds(event.at), textOr(event.body, "text")});
    return marks;
}

}  // namespace tacto::gui
