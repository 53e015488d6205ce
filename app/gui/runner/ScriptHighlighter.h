// ScriptHighlighter.h - colours of a protocol script: JavaScript's words, strings, comments, numbers, and the host's
// own objects.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QRegularExpression>
#include <QSyntaxHighlighter>
#include <vector>

namespace tacto::gui {

class ScriptHighlighter final : public QSyntaxHighlighter {
    Q_OBJECT
public:
    explicit ScriptHighlighter(QTextDocument* document);
    /// After a change of theme.
    void recolour();

protected:
    void highlightBlock(const QString& text) override;

private:
    struct Rule {
        QRegularExpression pattern;
        QTextCharFormat format;
    };
    std::vector<Rule> rules_;
    QTextCharFormat comment_;
};

}  // namespace tacto::gui
