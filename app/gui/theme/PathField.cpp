#include "app/gui/theme/PathField.h"

namespace tacto::gui {

PathField::PathField(const QString& path, const QString& tip, QWidget* parent) : QLineEdit(parent) {
    connect(this, &QLineEdit::textChanged, this, [this, tip](const QString& text) {
        if (!hasFocus()) setCursorPosition(0);
        setToolTip(text.isEmpty() ? tip : text + "\n" + tip);
    });
    setToolTip(tip);
    setText(path);
}

}  // namespace tacto::gui
