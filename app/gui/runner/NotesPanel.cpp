#include "app/gui/runner/NotesPanel.h"

#include <QFormLayout>

namespace tacto::gui {

NotesPanel::NotesPanel(QWidget* parent) : QGroupBox(tr("For the report"), parent) {
    auto* form = new QFormLayout(this);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    operator_ = field("operator", tr("who does the run"), tr("Stands on the report's first page, to be signed."));
    reviewer_ = field("reviewer", tr("who checks it"), tr("Stands on the report's first page, to be signed."));
    ambient_ =
        field("ambient", tr("22.5 °C, 45 % RH"), tr("Ambient conditions. As you enter them; none are measured."));
    form->addRow(tr("O&perator"), operator_);
    form->addRow(tr("Re&viewer"), reviewer_);
    form->addRow(tr("A&mbient"), ambient_);
}

QLineEdit* NotesPanel::field(const char* name, const QString& placeholder, const QString& tip) {
    auto* edit = new QLineEdit(this);
    edit->setObjectName(name);
    edit->setPlaceholderText(placeholder);
    edit->setToolTip(tip);
    edit->setMaxLength(static_cast<int>(kNoteLimit));
    return edit;
}

RunNotes NotesPanel::notes() const {
    const auto text = [](const QLineEdit* edit) { return edit->text().simplified().toStdString(); };
    return {text(operator_), text(reviewer_), text(ambient_)};
}

}  // namespace tacto::gui
