#include "app/gui/study/NextDayDialog.h"

#include <QGridLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/study/DialogField.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kNextDayWide = 560, kNextDayHigh = 580, kMinItemsHeight = 120;
}

NextDayDialog::NextDayDialog(OpenStudy& study, const QString& code, QWidget* parent)
    : StudyDialog(study, "nextDayDialog", tr("The day after a session"),
                  tr("Ask the participant on a later day. It is sealed; what is noted last counts. Skin that scores 2 "
                     "or more is noted as an adverse event."),
                  parent),
      form_(new ParameterForm) {
    ProtocolDeclaration fields;
    if (const auto* open = opened().study()) fields.parameters.push_back(sessionField(*open, code));
    const auto needed = tr("the site is not known to be well");
    fields.parameters.push_back(scoreField("erythema", tr("Redness of the skin"), kSkinScores, needed, 0));
    fields.parameters.push_back(scoreField("oedema", tr("Swelling of the skin"), kSkinScores, needed, 0));
    form_->setMissingSaidOnceLeft();
    form_->show(fields);
    form_->referencePart().hide();
    auto* inside = new QWidget;
    auto* rows = new QVBoxLayout(inside);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->addWidget(form_);
    rows->addWidget(buildItems());
    rows->addStretch();
    scroll(inside, scaledPx(kMinItemsHeight));
    auto* note = new QPushButton(tr("Note the answers"), this);
    note->setObjectName("noteDay");
    makePrimary(*note);
    finish("nextDayTrouble", note);
    connect(note, &QPushButton::clicked, this, &NextDayDialog::note);
    resize(scaledPx(kNextDayWide), kNextDayHigh);
}

QWidget* NextDayDialog::buildItems() {
    auto* holder = new QWidget;
    auto* grid = new QGridLayout(holder);
    grid->setContentsMargins(0, 0, 0, 0);
    const auto head = [&](const QString& text, int column) {
        auto* label = new QLabel(text, holder);
        setTextSize(*label, TextSize::Body, true);
        grid->addWidget(label, 0, column);
    };
    head(tr("Since then"), 0);
    head(tr("Severity"), 1);
    head(tr("Related to it"), 2);
    int row = 1;
    for (const auto& each : kSideEffects) {
        const auto text = QCoreApplication::translate("SideEffect", each.text);
        grid->addWidget(new QLabel(text, holder), row, 0);
        const auto box = [&](std::span<const char* const> words, const char* part, int column) {
            auto* made = new QComboBox(holder);
            made->setObjectName(QString("%1-%2").arg(each.key, part));
            made->setAccessibleName(QString("%1, %2").arg(text, part));
            made->addItem(column == 1 ? tr("not noticed") : QString("–"), 0);
            for (int score = 1; score <= int(words.size()); ++score) made->addItem(scoreChoice(words, score), score);
            grid->addWidget(made, row, column);
            return made;
        };
        const Item item{box(kSideEffectSeverities, "severity", 1), box(kRelations, "relation", 2)};
        item.relation->setEnabled(false);
        connect(item.severity, &QComboBox::currentIndexChanged, item.relation, [item](int index) {
            item.relation->setEnabled(index > 0);
            if (index == 0) item.relation->setCurrentIndex(0);
        });
        items_.push_back(item);
        ++row;
    }
    grid->setColumnStretch(0, 1);
    return holder;
}

void NextDayDialog::note() {
    auto* study = openStudy(tr("Nothing was noted."));
    if (study == nullptr) return;
    if (const auto open = form_->unanswered(); !open.isEmpty()) {
        form_->goToRefused();
        return refuse(open);
    }
    NextDay said;
    said.erythema = form_->text("erythema").toInt();
    said.oedema = form_->text("oedema").toInt();
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (items_[i].severity->currentIndex() == 0) continue;
        if (items_[i].relation->currentIndex() == 0) {
            items_[i].relation->setFocus();
            return refuse(tr("How “%1” is related to the session is missing. 1 to 5 is expected.")
                              .arg(QCoreApplication::translate("SideEffect", kSideEffects[i].text)));
        }
        said.sideEffects.push_back(
            {kSideEffects[i].key, items_[i].severity->currentIndex(), items_[i].relation->currentIndex()});
    }
    const auto noted = study->nextDay(form_->text("session").toStdString(), said);
    if (!noted) return refuse(noted.error());
    noteAndClose();
}

}  // namespace tacto::gui

#include "moc_NextDayDialog.cpp"
