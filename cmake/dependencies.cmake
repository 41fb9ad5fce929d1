# Everything that is not ours, found once. cmake/barkridge-config.cmake.in repeats for users what the
# libraries need.
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(hwy REQUIRED)
find_package(embree 3 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(OpenImageIO REQUIRED)
include(${CMAKE_CURRENT_LIST_DIR}/openimageio_without_opencv.cmake)
