# footwall_messages(engine/service NAME engine_messages PROTOS engine.proto RPC engine.proto)
#
# The C++ of message files as footwall::<NAME>, and of the services in those under RPC as footwall::<NAME>_rpc. Includes
# look as for every other folder: "engine/service/engine.pb.h", "engine/service/engine.grpc.pb.h".
function(footwall_messages FOLDER)
  cmake_parse_arguments(ARG "" "NAME" "PROTOS;RPC" ${ARGN})
  set(out ${CMAKE_BINARY_DIR}/messages)
  file(MAKE_DIRECTORY ${out}/${FOLDER})
  foreach(proto IN LISTS ARG_PROTOS)
    get_filename_component(base ${proto} NAME_WE)
    set(made ${out}/${FOLDER}/${base}.pb.cc ${out}/${FOLDER}/${base}.pb.h)
    add_custom_command(OUTPUT ${made}
      COMMAND protobuf::protoc --proto_path=${CMAKE_SOURCE_DIR} --cpp_out=${out} ${CMAKE_SOURCE_DIR}/${FOLDER}/${proto}
      DEPENDS ${CMAKE_SOURCE_DIR}/${FOLDER}/${proto} VERBATIM)
    list(APPEND messages ${made})
  endforeach()
  add_library(${ARG_NAME} STATIC ${messages})
  add_library(footwall::${ARG_NAME} ALIAS ${ARG_NAME})
  target_include_directories(${ARG_NAME} SYSTEM PUBLIC ${out})
  target_link_libraries(${ARG_NAME} PUBLIC protobuf::libprotobuf)
  foreach(proto IN LISTS ARG_RPC)
    get_filename_component(base ${proto} NAME_WE)
    set(made ${out}/${FOLDER}/${base}.grpc.pb.cc ${out}/${FOLDER}/${base}.grpc.pb.h)
    add_custom_command(OUTPUT ${made}
      COMMAND protobuf::protoc --proto_path=${CMAKE_SOURCE_DIR} --grpc_out=${out}
        --plugin=protoc-gen-grpc=$<TARGET_FILE:gRPC::grpc_cpp_plugin> ${CMAKE_SOURCE_DIR}/${FOLDER}/${proto}
      DEPENDS ${CMAKE_SOURCE_DIR}/${FOLDER}/${proto} VERBATIM)
    list(APPEND services ${made})
  endforeach()
  add_library(${ARG_NAME}_rpc STATIC ${services})
  add_library(footwall::${ARG_NAME}_rpc ALIAS ${ARG_NAME}_rpc)
  target_link_libraries(${ARG_NAME}_rpc PUBLIC ${ARG_NAME} gRPC::grpc++)
endfunction()
