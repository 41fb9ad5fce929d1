// What the report says, as other programs read it.

#include "study/report.h"

#include <catch2/catch.hpp>
#include <limits>

#include "study/measurement.h"

using namespace barkridge;
using Catch::Contains;

namespace {

Measurement measured(const char* model, const char* method, double seconds, double pixels) {
  Measurement m;
  m.model = model;
  m.method = method;
  m.build.median = 0.25 * seconds;
  m.surface.median = 0.75 * seconds;
  m.error = PixelError{10 * pixels, pixels};
  m.triangles = 1000;
  return m;
}

}  // namespace

TEST_CASE("the median of an even number of times is the mean of the middle two") {
  const Times four = times_of({4, 1, 3, 2});
  CHECK(four.median == 2.5);
  CHECK(four.least == 1);
  CHECK(four.most == 4);
  CHECK(times_of({7}).median == 7);
  CHECK(times_of({}).median == 0);
}

TEST_CASE("the headline compares the cheapest settings that are good enough") {
  std::vector<Measurement> all{measured("oak", "implicit", 2, 0.7),  measured("oak", "implicit", 6, 0.4),
                               measured("oak", "implicit", 9, 0.1),  measured("oak", "hull", 1, 0.3),
                               measured("oak", "templates", 3, 0.2), measured("ash", "implicit", 2, 0.4),
                               measured("ash", "hull", 1, 0.6)};
  all.push_back(measured("oak", "hull", 0.1, 0));
  all.back().error.reset();                             // not measured is not good
  all.push_back(measured("oak", "cylinders", 0.1, 0));  // no joints, no rival
  const std::vector<Headline> found = headlines(all);
  REQUIRE(found.size() == 2);
  CHECK(found[0].model == "oak");
  CHECK(found[0].implicit == &all[1]);
  CHECK(found[0].subdivision == &all[3]);
  CHECK(*found[0].ratio() == Approx(6));
  CHECK(found[1].subdivision == nullptr);
  CHECK_FALSE(found[1].ratio());
  CHECK(all[1].triangles_per_second() == Approx(1000 / 6.0));
}

TEST_CASE("a table is CSV that quotes what needs it") {
  const ReportTable table{
      "t", "T", {"name", "a, b"}, {{"plain", 1}, {"with \"quotes\"", nullptr}, {"two\nlines", 0.1}}};
  CHECK(csv(table) == "name,\"a, b\"\r\nplain,1\r\n\"with \"\"quotes\"\"\",\r\n\"two\nlines\",0.1\r\n");
}

TEST_CASE("a report is one page with its plots and pictures inside") {
  Report report{"Trees <& more>", {{"machine", "a \"fast\" one"}}, {}};
  report.sections.push_back({"Times",
                             {"One < two."},
                             {{"times", "Times", {"model", "s"}, {{"oak", 1.23456}, {"ash", nullptr}}}},
                             {{"A plot", "x", "y", {{"series & co", {{1, 1}, {10, 100}, {0, 5}, {-1, 2}}}}}},
                             {{"a picture", "M"}}});
  const std::string page = html(report);
  CHECK_THAT(page, Contains("<title>Trees &lt;&amp; more&gt;</title>") && Contains("a &quot;fast&quot; one"));
  CHECK_THAT(page, Contains("<p>One &lt; two.</p>") && Contains("<td>1.23</td>") && Contains("<svg"));
  CHECK_THAT(page, Contains("data:image/png;base64,TQ==") && Contains("series &amp; co"));
  CHECK_THAT(page, !Contains("nan") && !Contains("inf"));
  CHECK_THAT(page, !Contains("src=\"http") && !Contains("href"));
  const nlohmann::ordered_json values = json(report);
  CHECK(values["tables"]["times"][0]["s"] == 1.23456);
  CHECK(values["tables"]["times"][1]["s"].is_null());
  CHECK(values["facts"]["machine"] == "a \"fast\" one");
}

TEST_CASE("a plot puts its points where the decades say") {
  // The axes span 1 to 100 and 1 to 1000; (10, 10) lies half way along x and a third of the way up.
  const auto mark = [](glm::dvec2 p) {
    const std::string drawing = svg({"t", "x", "y", {{"s", {{1, 1}, {100, 1000}, p}, false}}});
    std::vector<std::pair<double, double>> places;
    for (std::size_t at = drawing.find("<circle"); at != std::string::npos; at = drawing.find("<circle", at + 1)) {
      places.emplace_back(std::stod(drawing.substr(drawing.find("cx=\"", at) + 4)),
                          std::stod(drawing.substr(drawing.find("cy=\"", at) + 4)));
    }
    return places;
  };
  const auto places = mark({10, 10});
  REQUIRE(places.size() == 4);  // and the key's
  CHECK(places[2].first == Approx((places[0].first + places[1].first) / 2));
  CHECK(places[2].second == Approx(places[0].second + (places[1].second - places[0].second) / 3).margin(0.1));
  CHECK(places[1].second < places[0].second);
  CHECK(mark({std::numeric_limits<double>::infinity(), 3}).size() == 3);
}

TEST_CASE("a plot of nothing says so") {
  CHECK_THAT(svg({"t", "x", "y", {{"s", {{0, 1}}}}}), Contains("nothing to show"));
}
