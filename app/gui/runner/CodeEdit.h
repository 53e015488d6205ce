// CodeEdit.h - a script's text with line numbers, one marked line, and marks on searched words.
#pragma once

#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QSyntaxHighlighter>
#include <vector>

namespace tacto::gui {

// Colours a protocol script: JavaScript keywords, strings, comments, numbers, and the objects that the program
// provides.

class ScriptHighlighter final : public QSyntaxHighlighter {
    Q_OBJECT
public:
    explicit ScriptHighlighter(QTextDocument* document);
    /// Updates the colours after a change of theme.
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

class CodeEdit final : public QPlainTextEdit {
    Q_OBJECT
public:
    explicit CodeEdit(QWidget* parent = nullptr);
    /// Marks a line, counted from 1, and goes there; 0 removes the mark.
    void mark(int line);
    [[nodiscard]] int marked() const { return marked_; }
    /// Marks every occurrence of these words, ignoring case; empty removes the marks. Returns how many there are.
    int markWords(const QString& words);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void paintNumbers(QPaintEvent* event, QWidget& margin);
    [[nodiscard]] int marginWidth() const;
    void showMarks();
    class Margin;
    QWidget* margin_;
    ScriptHighlighter* highlighter_;
    int marked_ = 0;
    QList<QTextCursor> found_;  // the places that markWords() found
};

}  // namespace tacto::gui
