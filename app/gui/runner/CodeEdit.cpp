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
    marked_ = std::min(line, blockCount());  // engines report a missing brace after the last line
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

ScriptHighlighter::ScriptHighlighter(QTextDocument* document) : QSyntaxHighlighter(document) { recolour(); }

void ScriptHighlighter::recolour() {
    const auto& c = colours();
    const auto in = [](const QColor& colour, bool bold = false) {
        QTextCharFormat format;
        format.setForeground(colour);
        if (bold) format.setFontWeight(QFont::Bold);
        return format;
    };
    rules_ = {
        {QRegularExpression(
             R"(\b(const|let|var|function|return|if|else|for|of|in|while|do|break|continue|new|throw|try|)"
             R"(catch|finally|true|false|null|undefined|typeof|switch|case|default)\b)"),
         in(c.voltage, true)},
        {QRegularExpression(
             R"(\b(bench|operator|analysis|report|random|record|measure|plot|protocol|progress|verdict|log)\b)"),
         in(c.third, true)},
        {QRegularExpression(R"(\b\d+(\.\d+)?([eE][+-]?\d+)?\b)"), in(c.voltage)},
        {QRegularExpression(R"("([^"\\]|\\.)*"|'([^'\\]|\\.)*'|`([^`\\]|\\.)*`)"), in(c.current)},
    };
    comment_ = in(c.quiet);
    comment_.setFontItalic(true);
    rehighlight();
}

void ScriptHighlighter::highlightBlock(const QString& text) {
    for (const auto& rule : rules_) {
        for (auto found = rule.pattern.globalMatch(text); found.hasNext();) {
            const auto match = found.next();
            setFormat(int(match.capturedStart()), int(match.capturedLength()), rule.format);
        }
    }
    // Comment colour overrides all others; block state 1 means inside /* */.
    static const QRegularExpression line(R"(^([^"'`]|"[^"]*"|'[^']*'|`[^`]*`)*?//)");
    if (const auto match = line.match(text); match.hasMatch() && previousBlockState() != 1) {
        const int start = int(match.capturedEnd()) - 2;
        setFormat(start, int(text.size()) - start, comment_);
    }
    setCurrentBlockState(0);
    qsizetype start = previousBlockState() == 1 ? 0 : text.indexOf("/*");
    while (start >= 0) {
        const auto end = text.indexOf("*/", start);
        if (end < 0) setCurrentBlockState(1);
        const auto length = end < 0 ? text.size() - start : end - start + 2;
        setFormat(int(start), int(length), comment_);
        start = end < 0 ? -1 : text.indexOf("/*", end + 2);
    }
}

}  // namespace tacto::gui

#include "moc_CodeEdit.cpp"
