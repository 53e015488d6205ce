#include "app/gui/window/DayDialog.h"

#include <QDialogButtonBox>
#include <QEvent>
#include <QMenuBar>
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

constexpr int kWidest = 40;  // characters

DayButton::DayButton(DayNotes& day, QWidget* parent) : QToolButton(parent), day_(day) {
    setObjectName("dayButton");
    setAutoRaise(true);
    setFocusPolicy(Qt::TabFocus);
    setTextSize(*this, TextSize::Small);
    connect(&day_, &DayNotes::changed, this, &DayButton::say);
    say();
}

void DayButton::say() {
    const auto words = day_.words(), nothing = tr("Operator and sample…");
    const auto& metrics = fontMetrics();
    const auto before = text();
    setText(words.isEmpty() ? nothing
                            : metrics.elidedText(words, Qt::ElideRight, kWidest * metrics.averageCharWidth()));
    setAccessibleName(words.isEmpty() ? nothing : tr("Operator and sample: %1").arg(words));
    setToolTip(words.isEmpty() ? tr("Not entered today: sessions and reports will say “not recorded”.")
                               : tr("%1: in every session and report of today. Press to change it.").arg(words));
    // A menu bar gives its corner room only when it is set.
    auto* bar = qobject_cast<QMenuBar*>(parentWidget());
    if (bar != nullptr && text() != before) bar->setCornerWidget(this, Qt::TopRightCorner);
}

/// Updates the text, because midnight may have passed.
void DayButton::changeEvent(QEvent* event) {
    QToolButton::changeEvent(event);
    if (event->type() == QEvent::ActivationChange) say();
}

}  // namespace tacto::gui

#include "moc_DayDialog.cpp"
