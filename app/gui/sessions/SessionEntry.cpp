#include "app/gui/sessions/SessionEntry.h"

#include <QFileInfo>
#include <QStringList>
#include <algorithm>

#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace fs = std::filesystem;

QString SessionEntry::searched() const {
    return QStringList{
        QString::fromStdString(path.string()), protocol, devices, verdict, problem, began.toString(Qt::ISODate),
        simulated ? "simulated" : ""}
        .join(' ')
        .toLower();
}

SessionEntry readEntry(const fs::path& path) {
    SessionEntry entry;
    entry.path = path;
    const QFileInfo file(QString::fromStdString(path.string()));
    entry.bytes = file.size();
    entry.began = file.lastModified();
    const auto reader = SessionReader::open(path);
    if (!reader) {
        entry.problem = QString::fromStdString(reader.error().message);
        return entry;
    }
    const auto& about = reader->about();
    if (const auto began = QDateTime::fromString(QString::fromStdString(about.wallStart), Qt::ISODate); began.isValid())
        entry.began = began.toLocalTime();
    entry.protocol = about.protocol.empty() ? QObject::tr("live") : QString::fromStdString(about.protocol);
    QStringList names;
    for (const auto& device : about.devices) names << QString::fromStdString(device.name);
    entry.devices = names.join(", ");
    entry.simulated = about.simulated;
    entry.closed = reader->closed();
    const auto verdicts = reader->verdicts();
    const auto events = reader->events();
    const auto streams = reader->streams();
    if (!verdicts || !events || !streams) {
        entry.problem = QString::fromStdString(!verdicts ? verdicts.error().message
                                               : !events ? events.error().message
                                                         : streams.error().message);
        return entry;
    }
    if (!verdicts->empty()) entry.verdict = QString::fromStdString(verdicts->back().verdict);
    for (const auto& event : *events) entry.duration_s = std::max(entry.duration_s, toSeconds(event.at));
    for (const auto& stream : *streams) {
        if (stream.samples > 0) entry.duration_s = std::max(entry.duration_s, stream.last_s);
    }
    return entry;
}

std::vector<fs::path> sessionFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    const auto look = [&](const fs::path& in, auto&& self, int depth) -> void {
        for (const auto& item : fs::directory_iterator(in, error)) {
            std::error_code gone;
            if (item.path().extension() == ".tacto" && item.is_regular_file(gone)) files.push_back(item.path());
            if (depth > 0 && item.is_directory(gone)) self(item.path(), self, depth - 1);
        }
    };
    look(folder, look, 1);
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.filename() > b.filename(); });
    return files;
}

}  // namespace tacto::gui
