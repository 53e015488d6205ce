#include "app/gui/runner/CodeEdit.h"

#include <QFontDatabase>
#include <QPainter>
#include <QTextBlock>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

class CodeEdit::Margin final : public QWidget {
public:
    explicit Margin(CodeEdit& editor) : QWidget(&editor), editor_(editor) {}

protected:
    void paintEvent(QPaintEvent* event) override { editor_.paintNumbers(event, *this); }

private:
    CodeEdit& editor_;
};

CodeEdit::CodeEdit(QWidget* parent) : QPlainTextEdit(parent), margin_(new Margin(*this)) {
    auto font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    font.setPointSizeF(QApplication::font().pointSizeF());
    setFont(font);
    setLineWrapMode(NoWrap);
    setTabStopDistance(2 * fontMetrics().horizontalAdvance(' '));
    highlighter_ = new ScriptHighlighter(document());
    connect(this, &QPlainTextEdit::blockCountChanged, this, [this] { setViewportMargins(marginWidth(), 0, 0, 0); });
    connect(this, &QPlainTextEdit::updateRequest, this, [this](const QRect& rect, int dy) {
        if (dy != 0)
            margin_->scroll(0, dy);
        else
            margin_->update(0, rect.y(), margin_->width(), rect.height());
    });
    setViewportMargins(marginWidth(), 0, 0, 0);
    onLookChange(*this, [this] {
        highlighter_->recolour();
        showMarks();
    });
}

int CodeEdit::marginWidth() const {
    const auto digitsNeeded = QString::number(std::max(99, blockCount())).size();
    return int(digitsNeeded) * fontMetrics().horizontalAdvance('9') + 12;
}

void CodeEdit::resizeEvent(QResizeEvent* event) {
    QPlainTextEdit::resizeEvent(event);
    const auto room = contentsRect();
    margin_->setGeometry(room.left(), room.top(), marginWidth(), room.height());
}

void CodeEdit::paintNumbers(QPaintEvent* event, QWidget& margin) {
    QPainter painter(&margin);
    painter.fillRect(event->rect(), palette().color(QPalette::AlternateBase));
    painter.setFont(font());
    for (auto block = firstVisibleBlock(); block.isValid(); block = block.next()) {
        const auto box = blockBoundingGeometry(block).translated(contentOffset());
        if (box.top() > event->rect().bottom()) break;
        const int number = block.blockNumber() + 1;
        painter.setPen(number == marked_ ? colours().amberText : colours().quiet);
        const QRectF cell(0, box.top(), margin.width() - 6, fontMetrics().height());
        painter.drawText(cell, Qt::AlignRight, (number == marked_ ? "▶" : "") + QString::number(number));
    }
}

void CodeEdit::mark(int line) {
    marked_ = std::min(line, blockCount());  // engines report a missing brace behind the end
    showMarks();
    margin_->update();
    if (line <= 0) return;
    const auto block = document()->findBlockByNumber(marked_ - 1);
    if (!block.isValid()) return;
    setTextCursor(QTextCursor(block));
    centerCursor();
}

int CodeEdit::markWords(const QString& words) {
    found_.clear();
    QTextCursor from(document());
    while (!words.isEmpty() && !(from = document()->find(words, from)).isNull()) found_ << from;
    showMarks();
    return int(found_.size());
}

void CodeEdit::showMarks() {
    QList<QTextEdit::ExtraSelection> selections;
    const auto block = document()->findBlockByNumber(marked_ - 1);
    if (marked_ > 0 && block.isValid()) {
        QTextEdit::ExtraSelection selection;
        auto tint = colours().amber;
        tint.setAlpha(50);
        selection.format.setBackground(tint);
        selection.format.setProperty(QTextFormat::FullWidthSelection, true);
        selection.cursor = QTextCursor(block);
        selections << selection;
    }
    for (const auto& found : found_) {
        QTextEdit::ExtraSelection selection;
        selection.format.setBackground(colours().selection);
        selection.cursor = found;
        selections << selection;
    }
    setExtraSelections(selections);
}

}  // namespace tacto::gui

#include "moc_CodeEdit.cpp"
