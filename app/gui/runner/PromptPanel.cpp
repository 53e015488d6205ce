#include "app/gui/runner/PromptPanel.h"

#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QSvgRenderer>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {

constexpr int kDrawingChars = 70;
constexpr int kStripe = 5;  // width in pixels of the amber stripe at the left: the run waits for a person

QString accepted(const OperatorQuestion& question) {
    const auto unit = QString::fromStdString(question.unit);
    if (question.min && question.max)
        return QObject::tr("%1 to %2").arg(settingText(*question.min, unit), settingText(*question.max, unit));
    if (question.min) return QObject::tr("at least %1").arg(settingText(*question.min, unit));
    if (question.max) return QObject::tr("at most %1").arg(settingText(*question.max, unit));
    return question.number && unit.isEmpty() ? QObject::tr("a number") : QString();
}

}  // namespace

PromptPanel::PromptPanel(WindowOperator& controller, QWidget* parent) : QFrame(parent), controller_(controller) {
    nameWidget(*this, "prompt", tr("Question"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    layout_ = columnIn(*this, -1, {kStripe * 3, kStripe, kStripe, kStripe});
    hide();
}

void PromptPanel::paintEvent(QPaintEvent* event) {
    QFrame::paintEvent(event);
    QPainter(this).fillRect(0, 0, kStripe, height(), colours().amber);
}

void PromptPanel::ask(const OperatorQuestion& question) {
    close();
    asked_ = question.id;
    body_ = new QWidget(this);
    first_ = nullptr;
    auto* column = columnIn(*body_);
    auto* says = makeLabel(QString::fromStdString(question.text), {.name = "question"}, body_);
    says->setTextFormat(Qt::PlainText);  // a script's words stay plain text, so no picture is loaded for them
    says->setWordWrap(true);
    setTextSize(*says, TextSize::Body, true);
    column->addWidget(says);
    if (auto* drawing = buildDrawing(question)) column->addWidget(drawing);
    auto* row = new QHBoxLayout;
    row->addWidget(question.kind == OperatorQuestion::Kind::Enter ? buildEntry(question) : buildChoices(question));
    row->addStretch();
    auto* refuse = pageButton(tr("&Refuse and end the run"), {},
                              tr("The output is switched off; what was recorded so far is kept."), body_);
    connect(refuse, &QPushButton::clicked, this, [this] { controller_.refuse(); });
    row->addWidget(refuse);
    if (first_ == nullptr) first_ = refuse;
    column->addLayout(row);
    trouble_ = new TroubleLine("promptTrouble", body_);
    column->addWidget(trouble_);
    layout_->addWidget(body_);
    show();
    if (first_ != nullptr) first_->setFocus();
}

void PromptPanel::close() {
    hide();
    if (body_ == nullptr) return;
    body_->deleteLater();  // perhaps called from a click on its own button
    body_->hide();
    body_ = nullptr;
    trouble_ = nullptr;
}

/// The background is white in both themes, as the drawing is made for paper.
QWidget* PromptPanel::buildDrawing(const OperatorQuestion& question) {
    if (question.drawing.empty()) return nullptr;
    const auto file = drawingFile(question.drawing);
    if (!file) return new QLabel("⚠ " + QString::fromStdString(file.error().message), body_);
    QSvgRenderer drawn(QString::fromStdString(file->string()));
    const double scale = devicePixelRatioF() * fontMetrics().averageCharWidth() * kDrawingChars /
                         std::max(1, drawn.defaultSize().width());
    QImage image((QSizeF(drawn.defaultSize()) * scale).toSize(), QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    drawn.render(&painter);
    painter.end();
    image.setDevicePixelRatio(devicePixelRatioF());
    auto* label = makeLabel({}, {.name = "drawing"}, body_);
    label->setAccessibleName(tr("Drawing: %1").arg(QString::fromStdString(question.drawing)));
    label->setPixmap(QPixmap::fromImage(image));
    return label;
}

QWidget* PromptPanel::buildChoices(const OperatorQuestion& question) {
    auto* holder = new QWidget(body_);
    auto* row = rowIn(*holder);
    const auto add = [&](const QString& text, const QString& key, const QString& tip) {
        auto* button = new ConfirmButton(text, holder);
        button->setToolTip(tip);
        connect(button, &QPushButton::clicked, this, [this, key] { answer(key); });
        row->addWidget(button);
        if (first_ == nullptr) first_ = button;
    };
    if (!question.confirms.empty()) {
        // This button must not get the focus, so that a held key cannot arm the output.
        add(tr("Arm output"), QString::fromStdString(question.confirms),
            tr("Confirms exactly what the sentence says."));
        first_->setObjectName("confirmArming");
        first_ = nullptr;
    } else if (question.kind == OperatorQuestion::Kind::Confirm) {
        add(tr("Done"), "yes", tr("Confirms that it is as the sentence says."));
    }
    for (const auto& [key, text] : question.choices) {
        const auto name = QString::fromStdString(key);
        add(text.empty() ? name : QString::fromStdString(text), name, tr("Answers \"%1\".").arg(name));
    }
    return holder;
}

QWidget* PromptPanel::buildEntry(const OperatorQuestion& question) {
    auto* holder = new QWidget(body_);
    auto* row = rowIn(*holder);
    auto* line = new QLineEdit(holder);
    nameWidget(*line, "answer", QString::fromStdString(question.text));
    line->setMinimumWidth(fontMetrics().averageCharWidth() * 16);
    row->addWidget(line);
    first_ = line;
    connect(line, &QLineEdit::returnPressed, this, [this, line] { answer(line->text()); });
    QStringList beside;
    if (const auto range = accepted(question); !range.isEmpty())
        beside << range;
    else if (!question.unit.empty())
        beside << axisUnit(0, QString::fromStdString(question.unit)).unit;
    row->addWidget(new QLabel(beside.join(' '), holder));
    line->setToolTip(tr("Type the answer; Return gives it to the protocol."));
    auto* enter = pageButton(tr("&Enter"), {}, tr("Gives this answer to the protocol (Return)."), holder);
    connect(enter, &QPushButton::clicked, this, [this, line] { answer(line->text()); });
    row->addWidget(enter);
    return holder;
}

void PromptPanel::answer(const QString& text) {
    const auto taken = controller_.answer(asked_, text.trimmed().toStdString());
    if (taken || trouble_ == nullptr) return;
    trouble_->say(QString::fromStdString(taken.error().message));
    if (first_ != nullptr) first_->setFocus();
}

}  // namespace tacto::gui

#include "moc_PromptPanel.cpp"
