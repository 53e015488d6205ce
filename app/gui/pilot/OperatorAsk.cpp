#include "app/gui/pilot/OperatorAsk.h"

#include <QCheckBox>
#include <QLineEdit>
#include <QPainter>

#include "app/gui/pilot/AnswerKeys.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr int kAskStripe = 5;  // width in pixels of the amber stripe at the left: the session is waiting
constexpr int kInRow = 6;      // number of choices placed in one row

/// On the participant's window, keys that stop are recorded as the participant's (StopKeys.h).
bool onTheirScreen(const QWidget& widget) { return widget.window()->property("stopsAs") == "participant"; }

}  // namespace

OperatorAsk::OperatorAsk(QWidget* parent) : QFrame(parent) {
    nameWidget(*this, "operatorAsk", tr("Question to the operator"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    layout_ = columnIn(*this, -1, {kAskStripe * 3, kAskStripe, kAskStripe, kAskStripe});
    hide();
}

void OperatorAsk::paintEvent(QPaintEvent* event) {
    QFrame::paintEvent(event);
    QPainter(this).fillRect(0, 0, kAskStripe, height(), colours().amber);
}

void OperatorAsk::ask(const PilotPrompt& prompt, quint64 id) {
    close();
    id_ = id;
    body_ = new QWidget(this);
    column_ = columnIn(*body_);
    column_->addWidget(makeLabel(
        qtext(prompt.text),
        {.name = "operatorQuestion", .size = TextSize::Body, .strong = true, .wraps = true, .plain = true}, body_));
    if (prompt.to == PromptTo::Both)
        column_->addWidget(explanation(tr("The participant has to press it as well."), body_));
    if (prompt.name == "stop-test")
        column_->addWidget(explanation(onTheirScreen(*this)
                                           ? tr("Press the red STOP beside this. Esc on this screen is the "
                                                "participant’s, and would test nothing.")
                                           : tr("Press the red STOP button, or Esc while this window has the keys."),
                                       body_));
    else if (prompt.kind == PromptKind::Text)
        addLine(prompt);
    else if (prompt.kind == PromptKind::Several)
        addSeveral(prompt);
    else
        addChoices(prompt);
    layout_->addWidget(body_);
    show();
    if (auto* line = body_->findChild<QLineEdit*>()) return line->setFocus();
    if (auto* first = body_->findChild<QPushButton*>()) first->setFocus();
}

void OperatorAsk::close() {
    hide();
    if (body_ == nullptr) return;
    body_->hide();
    body_->deleteLater();  // perhaps called from a click on one of its own buttons
    body_ = nullptr;
}

void OperatorAsk::press(int choice) {
    if (body_ == nullptr) return;
    const auto choices = body_->findChildren<ConfirmButton*>();
    if (choice < 1 || choice > choices.size() || !choices[choice - 1]->listens()) return;
    choices[choice - 1]->click();
}

void OperatorAsk::give(const PilotAnswer& answer) {
    const auto id = id_;
    close();
    emit answered(id, answer);
}

void OperatorAsk::addChoices(const PilotPrompt& prompt) {
    const int count = targetCount(prompt);
    QHBoxLayout* row = nullptr;
    for (int i = 0; i < count; ++i) {
        if (i % kInRow == 0) {
            row = new QHBoxLayout;
            column_->addLayout(row);
        }
        const bool scale = prompt.kind == PromptKind::Scale;
        const auto words = scale                             ? QString::number(prompt.least + i)
                           : prompt.kind == PromptKind::Hold ? tr("Held")
                                                             : qtext(prompt.targets[std::size_t(i)].text);
        auto* button = new ConfirmButton(words, body_);
        if (std::size_t(i) < prompt.targets.size()) button->setObjectName(qtext(prompt.targets[std::size_t(i)].key));
        connect(button, &QPushButton::clicked, this, [this, prompt, scale, i] {
            PilotAnswer answer;
            if (scale)
                answer.value = prompt.least + i;
            else
                answer.keys.push_back(prompt.targets.empty() ? "held" : prompt.targets[std::size_t(i)].key);
            give(std::move(answer));
        });
        row->addWidget(button);
        if (i + 1 == count || i % kInRow == kInRow - 1) row->addStretch();
    }
}

void OperatorAsk::addSeveral(const PilotPrompt& prompt) {
    std::vector<QCheckBox*> boxes;
    for (const auto& target : prompt.targets) {
        if (target.key == "done") continue;
        boxes.push_back(new QCheckBox(qtext(target.text), body_));
        boxes.back()->setObjectName(qtext(target.key));
        column_->addWidget(boxes.back());
    }
    auto* done = new ConfirmButton(tr("Done"), body_);
    connect(done, &QPushButton::clicked, this, [this, boxes] {
        PilotAnswer answer;
        for (const auto* box : boxes) {
            if (box->isChecked()) answer.keys.push_back(box->objectName().toStdString());
        }
        give(std::move(answer));
    });
    column_->addWidget(done, 0, Qt::AlignLeft);
}

void OperatorAsk::addLine(const PilotPrompt& /*prompt*/) {
    auto* row = new QHBoxLayout;
    auto* line = new QLineEdit(body_);
    nameWidget(*line, "operatorAnswer", tr("Answer"));
    line->setMinimumWidth(fontMetrics().averageCharWidth() * 24);
    auto* enter = new QPushButton(tr("&Enter"), body_);
    enter->setAutoDefault(false);
    const auto take = [this, line] {
        PilotAnswer answer;
        answer.keys.push_back(line->text().trimmed().toStdString());
        give(std::move(answer));
    };
    connect(line, &QLineEdit::returnPressed, this, take);
    connect(enter, &QPushButton::clicked, this, take);
    addAll(*row, {line, enter});
    row->addStretch();
    column_->addLayout(row);
}

}  // namespace tacto::gui

#include "moc_OperatorAsk.cpp"
