#include "app/gui/runner/ScriptHighlighter.h"

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

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
    // Comments win over all else; block state 1: inside /* */.
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

#include "moc_ScriptHighlighter.cpp"
