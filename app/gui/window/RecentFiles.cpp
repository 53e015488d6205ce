#include "app/gui/window/RecentFiles.h"

#include <QFileInfo>
#include <QSettings>

namespace tacto::gui {

QStringList recentFiles() { return QSettings().value("recent").toStringList(); }

void rememberRecentFile(const QString& path) {
    constexpr qsizetype kMaxFiles = 8;
    auto files = recentFiles();
    const auto absolute = QFileInfo(path).absoluteFilePath();
    files.removeAll(absolute);
    files.prepend(absolute);
    QSettings().setValue("recent", QStringList(files.mid(0, kMaxFiles)));
}

}  // namespace tacto::gui
