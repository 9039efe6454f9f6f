`define uvm_object_utils(T) typedef uvm_object_registry#(T) type_id;
