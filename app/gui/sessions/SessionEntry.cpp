#include "app/gui/sessions/SessionEntry.h"

#include <QFileInfo>
#include <QStandardPaths>
#include <QStringList>
#include <algorithm>

#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace fs = std::filesystem;

SessionEntry::SessionEntry(ListedSession listed)
    : path(std::move(listed.path)),
      summary(std::move(listed.summary)),
      began(QDateTime::fromString(qtext(summary.wallStart), Qt::ISODate).toLocalTime()),
      bytes(qint64(listed.bytes)),
      elsewhere(!summary.closed && openElsewhere(path)),
      problem(qtext(listed.problem)) {
    if (!began.isValid()) began = QFileInfo(qtext(path.string())).lastModified();
    began_ms = began.toMSecsSinceEpoch();
    const auto& labels = summary.labels;
    QStringList all{qtext(path.string()),
                    procedureText(summary.protocol),
                    qtext(summary.protocol),
                    qtext(summary.verdict),
                    qtext(labels.operatorName),
                    qtext(labels.sample),
                    qtext(labels.note),
                    problem,
                    began.toString(Qt::ISODate),
                    beganText(began),
                    summary.simulated ? "simulated" : "",
                    summary.faulted ? "fault" : ""};
    for (const auto& tag : labels.tags) all << qtext(tag);
    for (const auto& device : summary.devices) all << qtext(device);
    searched = all.join('\n').toLower();
}

SessionIndex userSessionIndex() {
    const auto caches = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
    return SessionIndex(fs::path(caches.toStdString()) / "tactoscope" / "sessions.index");
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
