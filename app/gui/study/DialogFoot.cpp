#include "app/gui/study/DialogFoot.h"

#include <QDialogButtonBox>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

QPushButton* addFoot(QDialog& dialog, QVBoxLayout& column, QLabel& trouble, QPushButton* act) {
    trouble.setTextFormat(Qt::PlainText);
    trouble.setWordWrap(true);
    setTone(trouble, Tone::Warning);
    column.addWidget(&trouble);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, &dialog);
    buttons->addButton(act, QDialogButtonBox::ActionRole);
    auto* cancel = buttons->button(QDialogButtonBox::Cancel);
    for (auto* button : {cancel, act}) button->setAutoDefault(false);
    column.addWidget(buttons);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    return cancel;
}

}  // namespace tacto::gui
