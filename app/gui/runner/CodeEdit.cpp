#include "app/gui/runner/CodeEdit.h"

#include <QFontDatabase>
#include <QKeyEvent>
#include <Qsci/qscilexerjavascript.h>
#include <algorithm>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kNumbers = 0, kArrows = 1;                     // margins
constexpr int kMarkedLine = 0, kMarkedArrow = 1;             // markers
constexpr int kFoundWords = QsciScintilla::INDIC_CONTAINER;  // indicator

/// JavaScript, and the objects that the program provides.
class ScriptLexer final : public QsciLexerJavaScript {
public:
    using QsciLexerJavaScript::QsciLexerJavaScript;

    [[nodiscard]] const char* keywords(int set) const override {
        constexpr int kObjects = 2;
        return set == kObjects
                   ? "bench operator analysis report random record measure plot protocol progress verdict log"
                   : QsciLexerJavaScript::keywords(set);
    }
};

}  // namespace

CodeEdit::CodeEdit(QWidget* parent) : QsciScintilla(parent) {
    setLexer(new ScriptLexer(this));
    setUtf8(true);
    setEolMode(EolUnix);
    setIndentationsUseTabs(false);
    setIndentationWidth(2);
    setAutoIndent(true);
    setBraceMatching(SloppyBraceMatch);
    setScrollWidth(1);  // as wide as the text asks
    setScrollWidthTracking(true);
    setMarginLineNumbers(kNumbers, true);
    setMarginType(kArrows, SymbolMargin);
    setMarginMarkerMask(kArrows, 1 << kMarkedArrow);
    markerDefine(Background, kMarkedLine);
    markerDefine(RightTriangle, kMarkedArrow);
    indicatorDefine(StraightBoxIndicator, kFoundWords);
    setIndicatorDrawUnder(true, kFoundWords);
    onLookChange(*this, [this] { recolour(); });
    recolour();
}

void CodeEdit::recolour() {
    const auto& c = colours();
    auto font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    font.setPointSizeF(QApplication::font().pointSizeF());
    auto* script = lexer();
    script->setDefaultPaper(palette().color(QPalette::Base));
    script->setDefaultColor(palette().color(QPalette::Text));
    script->setPaper(palette().color(QPalette::Base));  // of every style, as the two below
    script->setColor(palette().color(QPalette::Text));
    script->setFont(font);
    auto bold = font, italic = font;
    bold.setBold(true);
    italic.setItalic(true);
    using Script = QsciLexerJavaScript;
    const auto style = [script](std::initializer_list<int> styles, const QColor& colour, const QFont& styled) {
        for (const int each : styles) {
            script->setColor(colour, each);
            script->setFont(styled, each);
        }
    };
    style({Script::Keyword}, c.voltage, bold);
    style({Script::KeywordSet2}, c.third, bold);
    style({Script::Number}, c.voltage, font);
    style({Script::DoubleQuotedString, Script::SingleQuotedString, Script::RawString, Script::UnclosedString,
           Script::Regex},
          c.current, font);
    style({Script::Comment, Script::CommentLine, Script::CommentDoc, Script::CommentLineDoc}, c.quiet, italic);
    setMarginsFont(font);
    setMarginsBackgroundColor(palette().color(QPalette::AlternateBase));
    setMarginsForegroundColor(c.quiet);
    setMarginWidth(kNumbers, QStringLiteral("00000"));
    setMarginWidth(kArrows, QStringLiteral("00"));
    setCaretForegroundColor(palette().color(QPalette::Text));
    setSelectionBackgroundColor(c.selection);
    setSelectionForegroundColor(palette().color(QPalette::Text));
    setMatchedBraceBackgroundColor(c.selection);
    setMatchedBraceForegroundColor(palette().color(QPalette::Text));
    setUnmatchedBraceForegroundColor(c.amberText);
    auto tint = c.amber;
    tint.setAlpha(50);
    setMarkerBackgroundColor(tint, kMarkedLine);
    setMarkerBackgroundColor(c.amberText, kMarkedArrow);
    setMarkerForegroundColor(c.amberText, kMarkedArrow);
    setIndicatorForegroundColor(c.selection, kFoundWords);
    SendScintilla(SCI_INDICSETALPHA, kFoundWords, 110L);  // weaker than the selection
}

/// Esc stops the output or closes a search: it is never a key of the text.
void CodeEdit::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) return event->ignore();
    QsciScintilla::keyPressEvent(event);
}

void CodeEdit::mark(int line, bool goThere) {
    marked_ = std::min(line, lines());  // engines report a missing brace after the last line
    markerDeleteAll();
    if (line <= 0) return;
    for (const int marker : {kMarkedLine, kMarkedArrow}) markerAdd(marked_ - 1, marker);
    if (!goThere) return;
    setCursorPosition(marked_ - 1, 0);
    SendScintilla(SCI_VERTICALCENTRECARET);
}

int CodeEdit::markWords(const QString& words) {
    found_.clear();
    const long end = SendScintilla(SCI_GETLENGTH);
    SendScintilla(SCI_SETINDICATORCURRENT, kFoundWords);
    SendScintilla(SCI_INDICATORCLEARRANGE, 0UL, end);
    SendScintilla(SCI_SETSEARCHFLAGS, 0UL);
    const auto wanted = words.toUtf8();
    for (long from = 0; !wanted.isEmpty();) {
        SendScintilla(SCI_SETTARGETSTART, from);
        SendScintilla(SCI_SETTARGETEND, end);
        if (SendScintilla(SCI_SEARCHINTARGET, static_cast<unsigned long>(wanted.size()), wanted.constData()) < 0) break;
        const Place place{SendScintilla(SCI_GETTARGETSTART), SendScintilla(SCI_GETTARGETEND)};
        SendScintilla(SCI_INDICATORFILLRANGE, static_cast<unsigned long>(place.from), place.to - place.from);
        found_ << place;
        from = place.to;
    }
    return int(found_.size());
}

bool CodeEdit::selectFound(bool forward) {
    if (found_.isEmpty()) return false;
    const long from = SendScintilla(forward ? SCI_GETSELECTIONEND : SCI_GETSELECTIONSTART);
    const Place* place = nullptr;
    for (const auto& each : found_) {
        if (forward ? each.from >= from && place == nullptr : each.to <= from) place = &each;
    }
    const bool wrapped = place == nullptr;
    if (wrapped) place = forward ? &found_.front() : &found_.back();
    SendScintilla(SCI_SETSEL, static_cast<unsigned long>(place->from), place->to);
    return wrapped;
}

int CodeEdit::selectedFound() const {
    const auto at = std::ranges::find_if(found_, [this](const Place& place) {
        return place.from == SendScintilla(SCI_GETSELECTIONSTART) && place.to == SendScintilla(SCI_GETSELECTIONEND);
    });
    return at == found_.end() ? 0 : int(at - found_.begin()) + 1;
}

}  // namespace tacto::gui

#include "moc_CodeEdit.cpp"
