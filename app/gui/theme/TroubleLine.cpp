#include "app/gui/theme/TroubleLine.h"

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

TroubleLine::TroubleLine(const QString& name, QWidget* parent) : QLabel(parent) {
    setObjectName(name);
    setTextFormat(Qt::PlainText);
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    setWordWrap(true);
    setTone(*this, Tone::Warning);
    hide();
}

void TroubleLine::say(const QString& why) {
    setText(why.isEmpty() ? QString() : "⚠ " + why);
    setVisible(!why.isEmpty());
}

}  // namespace tacto::gui
