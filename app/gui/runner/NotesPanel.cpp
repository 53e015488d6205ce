#include "app/gui/runner/NotesPanel.h"

#include <QFormLayout>

#include "app/gui/theme/Building.h"

namespace tacto::gui {

NotesPanel::NotesPanel(DayNotes& day, QWidget* parent) : QGroupBox(tr("For the report"), parent), day_(day) {
    auto* form = layoutIn<QFormLayout>(*this, -1, {});
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    const auto add = [&](const QString& label, const char* name, std::string RunNotes::*text,
                         const QString& placeholder, const QString& tip) {
        auto* edit = new QLineEdit(this);
        edit->setObjectName(name);
        edit->setPlaceholderText(placeholder);
        edit->setToolTip(tip);
        edit->setMaxLength(static_cast<int>(kNoteLimit));
        connect(edit, &QLineEdit::textEdited, this, [this, edit] { takeUp(*edit); });
        form->addRow(label, edit);
        fields_.push_back({edit, text});
    };
    const auto all = tr("The same for all sessions of today. ");
    add(tr("&Operator"), "operator", &RunNotes::operatorName, tr("who does the run"),
        all + tr("Stands on the report's first page, to be signed."));
    add(tr("Samp&le"), "sample", &RunNotes::sample, tr("your own id"),
        all + tr("Stands on the report's first page and in the list of sessions."));
    add(tr("Reviewer"), "reviewer", &RunNotes::reviewer, tr("who checks it"),
        all + tr("Stands on the report's first page, to be signed."));
    add(tr("A&mbient"), "ambient", &RunNotes::ambient, tr("22.5 °C, 45 % RH"),
        all + tr("Ambient conditions. As you enter them; none are measured."));
    connect(&day_, &DayNotes::changed, this, &NotesPanel::load);
    load();
    onEvent(*this, QEvent::Show, [this] { load(); });
}

/// Clears the other fields if they still show notes from another day.
void NotesPanel::takeUp(const QLineEdit& edited) {
    if (!day_.asked()) {
        for (const auto& field : fields_) {
            if (field.edit != &edited) field.edit->clear();
        }
    }
    day_.set(notes());
}

void NotesPanel::load() {
    const auto now = day_.notes();
    for (const auto& [edit, text] : fields_) {
        const auto stored = QString::fromStdString(now.*text);
        // A field is not changed while the user types in it: a trailing blank would be lost.
        if (edit->text().simplified() != stored) edit->setText(stored);
    }
}

RunNotes NotesPanel::notes() const {
    RunNotes notes;
    for (const auto& [edit, text] : fields_) notes.*text = edit->text().simplified().toStdString();
    return notes;
}

}  // namespace tacto::gui

#include "moc_NotesPanel.cpp"
