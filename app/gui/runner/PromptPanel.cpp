#include "app/gui/runner/PromptPanel.h"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>

#include "app/gui/look/Look.h"

namespace tacto::gui {

PromptPanel::PromptPanel(OperatorDesk& desk, QWidget* parent) : QFrame(parent), desk_(desk) {
    setObjectName("prompt");
    setAccessibleName(tr("Question"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    layout_ = new QVBoxLayout(this);
    connect(&desk_, &OperatorDesk::asked, this, &PromptPanel::ask);
    connect(&desk_, &OperatorDesk::closed, this, &QWidget::hide);
    hide();
}

void PromptPanel::ask(const OperatorQuestion& question) {
    delete body_;
    body_ = new QWidget(this);
    auto* column = new QVBoxLayout(body_);
    column->setContentsMargins(0, 0, 0, 0);
    auto* says = new QLabel(QString::fromStdString(question.text), body_);
    says->setWordWrap(true);
    auto font = says->font();
    font.setPointSizeF(font.pointSizeF() * 1.15);
    says->setFont(font);
    column->addWidget(says);
    auto* row = new QHBoxLayout;
    QWidget* first = nullptr;
    const auto add = [&](const QString& text, auto act) {
        auto* button = new QPushButton(text, body_);
        button->setAutoDefault(false);
        connect(button, &QPushButton::clicked, this, act);
        row->addWidget(button);
        if (first == nullptr) first = button;
        return button;
    };
    if (question.kind == OperatorQuestion::Kind::Confirm) {
        add(tr("&Done"), [this] { answer("yes"); });
    } else if (question.kind == OperatorQuestion::Kind::Choose) {
        for (const auto& [key, text] : question.choices) {
            add(QString::fromStdString(text.empty() ? key : text),
                [this, chosen = QString::fromStdString(key)] { answer(chosen); });
        }
    } else {
        auto* line = new QLineEdit(body_);
        line->setAccessibleName(QString::fromStdString(question.text));
        row->addWidget(line, 1);
        if (!question.unit.empty()) row->addWidget(new QLabel(QString::fromStdString(question.unit), body_));
        first = line;
        connect(line, &QLineEdit::returnPressed, this, [this, line] { answer(line->text()); });
        add(tr("&Enter"), [this, line] { answer(line->text()); });
    }
    row->addStretch();
    add(tr("&Refuse: end the run"), [this] { desk_.refuse(); });
    column->addLayout(row);
    trouble_ = new QLabel(body_);
    trouble_->setObjectName("promptTrouble");
    trouble_->setWordWrap(true);
    auto red = trouble_->palette();
    red.setColor(QPalette::WindowText, colours().fault);
    trouble_->setPalette(red);
    trouble_->hide();
    column->addWidget(trouble_);
    layout_->addWidget(body_);
    show();
    if (first != nullptr) first->setFocus();
}

void PromptPanel::answer(const QString& text) {
    const auto taken = desk_.answer(text.trimmed().toStdString());
    if (taken || trouble_ == nullptr) return;
    trouble_->setText(QString::fromStdString(taken.error().message));
    trouble_->show();
}

}  // namespace tacto::gui
