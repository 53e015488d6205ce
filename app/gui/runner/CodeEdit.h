// CodeEdit.h - a script's text, edited by QScintilla: line numbers, one marked line, and marks on searched words.
#pragma once

#include <QList>
#include <Qsci/qsciscintilla.h>

namespace tacto::gui {

class CodeEdit final : public QsciScintilla {
    Q_OBJECT
public:
    explicit CodeEdit(QWidget* parent = nullptr);
    /// Marks a line, counted from 1; 0 removes the mark. `goThere` also moves the cursor to the line.
    void mark(int line, bool goThere = true);
    [[nodiscard]] int marked() const { return marked_; }

    /// Marks every place with these words, ignoring case; empty removes the marks. Returns how many there are.
    int markWords(const QString& words);
    /// Selects the next or the previous marked place, from the start or end of the selection. Returns true if it went
    /// round the end of the text.
    bool selectFound(bool forward);
    /// Returns the number of the selected place, from 1; 0 if none is selected.
    [[nodiscard]] int selectedFound() const;

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Place {
        long from, to;  // in bytes
    };
    void recolour();
    int marked_ = 0;
    QList<Place> found_;  // the places that markWords() found
};

}  // namespace tacto::gui
