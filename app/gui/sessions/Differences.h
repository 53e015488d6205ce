// Differences.h - what differs between two sessions, in sentences with numbers: "The second delivered 40.2 V where the
// first delivered 39.8 V."
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
/// Differences in what was found come first, then in what was used. Empty where nothing differs.
[[nodiscard]] QList<Difference> differencesOf(const ReadSession& first, const ReadSession& second);

}  // namespace tacto::gui
