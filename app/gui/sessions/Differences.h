// Differences.h - says in sentences with numbers how two sessions differ: "The second delivered 40.2 V where the first
// delivered 39.8 V."
//
// Thread-safety: pure function.
#pragma once

#include <QList>
#include <QString>

#include "app/gui/sessions/ReadSession.h"

namespace tacto::gui {

struct Difference {
    enum class About { Found, Used };
    About about = About::Found;
    QString sentence;
};
/// Returns differences in the results first, then in the settings. Empty if nothing differs.
[[nodiscard]] QList<Difference> differencesOf(const ReadSession& first, const ReadSession& second);

}  // namespace tacto::gui
