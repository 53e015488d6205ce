// RecentFiles.h - the files that were opened last, newest first, from one start to the next.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>

namespace tacto::gui {

[[nodiscard]] QStringList recentFiles();
void rememberRecentFile(const QString& path);

}  // namespace tacto::gui
