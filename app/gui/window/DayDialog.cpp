#include "app/gui/window/DayDialog.h"

#include <QDialogButtonBox>
#include <QEvent>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/runner/NotesPanel.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QString wordsOf(const RunNotes& notes) {
    QStringList words;
    if (!notes.operatorName.empty()) words << QString::fromStdString(notes.operatorName);
    if (!notes.sample.empty()) words << QObject::tr("sample %1").arg(QString::fromStdString(notes.sample));
    return words.join(", ");
}

}  // namespace

DayDialog::DayDialog(DayNotes& day, QWidget* parent) : QDialog(parent) {
    setWindowTitle(tr("Operator and sample"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(heading(tr("Who is working today, and on what?"), this));
    layout->addWidget(
        explanation(tr("Asked once a day. It appears in every session and report of today; you can change "
                       "it at any time at the right of the menu bar."),
                    this));
    layout->addWidget(new NotesPanel(day, this));
    auto* buttons = new QDialogButtonBox(this);
    const auto before = day.before();
    if (const auto words = wordsOf(before); !words.isEmpty() && wordsOf(day.notes()).isEmpty()) {
        auto* again = buttons->addButton(tr("As before: %1").arg(words), QDialogButtonBox::ActionRole);
        again->setAutoDefault(false);
        connect(again, &QPushButton::clicked, this, [&day, before] {
            day.set({.operatorName = before.operatorName, .sample = before.sample, .reviewer = {}, .ambient = {}});
        });
    }
    makePrimary(*buttons->addButton(tr("Done"), QDialogButtonBox::AcceptRole));
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(this, &QDialog::finished, &day, &DayNotes::noteAsked);
    layout->addWidget(buttons);
    resize(fontMetrics().averageCharWidth() * 64, sizeHint().height());
    growWithContent(*this);
}

DayButton::DayButton(DayNotes& day, QWidget* parent) : QToolButton(parent), day_(day) {
    setObjectName("dayButton");
    setAutoRaise(true);
    setFocusPolicy(Qt::TabFocus);
    setTextSize(*this, TextSize::Small);
    connect(&day_, &DayNotes::changed, this, &DayButton::say);
    say();
}

void DayButton::say() {
    const auto words = day_.words();
    setText(words.isEmpty() ? tr("Operator and sample…") : words);
    setAccessibleName(words.isEmpty() ? text() : tr("Operator and sample: %1").arg(words));
    setToolTip(words.isEmpty() ? tr("Not entered today: sessions and reports will say “not recorded”.")
                               : tr("In every session and report of today. Press to change it."));
}

/// Updates the text, because midnight may have passed.
void DayButton::changeEvent(QEvent* event) {
    QToolButton::changeEvent(event);
    if (event->type() == QEvent::ActivationChange) say();
}

}  // namespace tacto::gui

#include "moc_DayDialog.cpp"
