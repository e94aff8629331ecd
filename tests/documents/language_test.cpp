// Language of comments, help, messages and documents (CONTRIBUTING.md).
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/documents/language_rules.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

std::string Repeated(const std::string& word, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += word + " ";
  return text;
}

bool IsRefused(const std::string& text, TextKind kind = TextKind::kProduct) {
  return !LanguageFaults(text, kind).empty();
}

TEST(Language, RepositoryFollowsItsRules) {
  std::size_t shown = 0;
  for (const auto& [file, faults] : RepositoryLanguageFaults(ARTHRO_SOURCE_DIR))
    for (const LanguageFault& fault : faults)
      if (++shown <= 100) ADD_FAILURE() << file.string() << ":" << fault.line << ": " << fault.what;
  EXPECT_EQ(shown, 0u) << "language_lint --counts lists them by folder";
}

TEST(Language, RefusesCommentsThatOpenWithoutSubject) {
  for (const char* opening : {"Of", "What", "Where", "As", "By", "Who", "That", "Which"}) {
    EXPECT_TRUE(IsRefused(std::string("// ") + opening + " the tissue.\n")) << opening;
    EXPECT_TRUE(IsRefused(std::string("/// ") + opening + ": the tissue.\n")) << opening;
    EXPECT_TRUE(IsRefused(std::string("# ") + opening + " the tissue.\n", TextKind::kScript));
  }
  EXPECT_TRUE(IsRefused("int a = 0;  // of the tissue\n"));
  EXPECT_TRUE(IsRefused("  int a = 0;  // m\n  // of the tissue\n"));
  EXPECT_TRUE(IsRefused("f(a,  // Where it lies\n  b);\n"));
  EXPECT_TRUE(IsRefused("// Keeps the nearest.\n// Of too many the first.\n"));
  EXPECT_TRUE(IsRefused("const char* shader = R\"(\n  // what lies far\n  float a;)\";\n"));
}

TEST(Language, AcceptsLinesThatContinueASentence) {
  for (const char* plain :
       {"// Keeps the nearest contacts when there are more\n// of them than kMaxToolContacts.\n",
        "double a = 0;  // m/N, compliance\n               // of the tissue\n",
        "// Offset of a pixel, by which it is found.\n", "// Ofcom and Bystander are names.\n",
        "const char* url = \"http://of.what/\";\n", "const char quote = '\"'; // Quote.\n",
        "const int many = 1'000'000;  // steps\n"})
    EXPECT_FALSE(IsRefused(plain)) << plain;
}

TEST(Language, RefusesSentencesOfMoreThanThirtyWordsInMessages) {
  EXPECT_FALSE(IsRefused("throw Error(\"" + Repeated("word", 30) + "\");"));
  EXPECT_TRUE(IsRefused("throw Error(\"" + Repeated("word", 31) + "\");"));
  EXPECT_TRUE(
      IsRefused("v(\"a\", \"" + Repeated("word", 16) + "\"\n  \"" + Repeated("word", 15) + "\");"));
  EXPECT_FALSE(IsRefused("f(\"" + Repeated("word", 20) + "end. " + Repeated("word", 20) + "\");"));
  EXPECT_FALSE(IsRefused("f(\"" + Repeated("word", 31) + "\");", TextKind::kSource));
}

TEST(Language, RefusesHelpThatIsNoSentence) {
  EXPECT_TRUE(
      IsRefused("job->add_option(\"--lens\", lens, \"Lens file of\"\n \" a job\")->required();"));
  EXPECT_TRUE(IsRefused("job.add_flag(\"-q\", quiet, \"Print (nothing\");"));
  EXPECT_TRUE(IsRefused("v(\"a\", a, Range{1, 2}, \"px\", \"Width of it\");"));
  EXPECT_FALSE(IsRefused("v(\"a\", a, Range{1, 2}, \"px\", \"Width, \\\"a\\\", of it.\");"));
  EXPECT_FALSE(IsRefused("job->add_option(\"--lens\", lens, kHelp);"));
  EXPECT_FALSE(IsRefused("job->add_option(\"--law\", law, \"One of \" + Names());"));
}

TEST(Language, RefusesImagesWhereATermExists) {
  for (const char* image : {"Take every so-manieth frame.", "4 looks a pixel", "The say of a frame",
                            "60 steps a second", "It costs a look at a box.",
                            "Light is thrown back.", "One a tissue."}) {
    EXPECT_TRUE(IsRefused(std::string("f(\"") + image + "\");")) << image;
    EXPECT_TRUE(IsRefused(std::string("// Note: ") + image)) << image;
    EXPECT_TRUE(IsRefused(image, TextKind::kDocument)) << image;
  }
  for (const char* term : {"Take every N-th frame.", "4 samples per pixel", "60 steps per second",
                           "A look-up table.", "It looks a bit dim."})
    EXPECT_FALSE(IsRefused(std::string("f(\"") + term + "\");")) << term;
}

}  // namespace
}  // namespace arthro::test
