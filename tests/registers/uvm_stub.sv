// As much of UVM's register layer (IEEE 1800.2) as ./run registers --format ral uses: names and types, without behaviour.
package uvm_pkg;
  typedef logic [63:0] uvm_reg_addr_t;
  typedef logic [63:0] uvm_reg_data_t;
  typedef enum {UVM_NO_ENDIAN, UVM_LITTLE_ENDIAN, UVM_BIG_ENDIAN, UVM_LITTLE_FIFO, UVM_BIG_FIFO} uvm_endianness_e;
  parameter int UVM_NO_COVERAGE = 0;
  typedef enum {UVM_IS_OK, UVM_NOT_OK, UVM_HAS_X} uvm_status_e;
  typedef enum {UVM_NO_CHECK, UVM_CHECK} uvm_check_e;
  typedef class uvm_reg_block;
  typedef class uvm_reg_field;

  virtual class uvm_object;
    function new(string name = "");
    endfunction
    virtual function string get_full_name();
      return "";
    endfunction
  endclass

  class uvm_object_registry #(type T = int);
    static function T create(string name = "");
      T made = new(name);
      return made;
    endfunction
  endclass

  virtual class uvm_reg_file extends uvm_object;
  endclass

  virtual class uvm_reg extends uvm_object;
    function new(string name = "", int unsigned n_bits, int has_coverage);
      super.new(name);
    endfunction
    function void configure(uvm_reg_block blk_parent, uvm_reg_file regfile_parent = null, string hdl_path = "");
    endfunction
    virtual function void build();
    endfunction
    virtual task write(output uvm_status_e status, input uvm_reg_data_t value);
      status = UVM_IS_OK;
    endtask
    virtual task mirror(output uvm_status_e status, input uvm_check_e check = UVM_NO_CHECK);
      status = UVM_IS_OK;
    endtask
    virtual function void get_fields(ref uvm_reg_field fields[$]);
    endfunction
  endclass

  class uvm_resource_db #(type T = int);
    static function void set(string scope, string name, T val);
    endfunction
  endclass

  class uvm_reg_field extends uvm_object;
    typedef uvm_object_registry#(uvm_reg_field) type_id;
    rand uvm_reg_data_t value;
    function new(string name = "uvm_reg_field");
      super.new(name);
    endfunction
    function void configure(uvm_reg parent, int unsigned size, int unsigned lsb_pos, string access, bit volatile, uvm_reg_data_t reset, bit has_reset, bit is_rand,
                            bit individually_accessible);
    endfunction
    virtual function uvm_reg_data_t get_mirrored_value();
      return value;
    endfunction
  endclass

  class uvm_reg_map extends uvm_object;
    virtual function void add_reg(uvm_reg rg, uvm_reg_addr_t offset, string rights = "RW", bit unmapped = 0);
    endfunction
    virtual function void set_sequencer(uvm_object sequencer, uvm_object adapter = null);
    endfunction
    virtual function void add_submap(uvm_reg_map child_map, uvm_reg_addr_t offset);
    endfunction
  endclass

  virtual class uvm_reg_block extends uvm_object;
    uvm_reg_map default_map;
    function new(string name = "", int has_coverage = UVM_NO_COVERAGE);
      super.new(name);
    endfunction
    function void configure(uvm_reg_block parent = null, string hdl_path = "");
    endfunction
    virtual function void build();
    endfunction
    virtual function uvm_reg_map create_map(string name, uvm_reg_addr_t base_addr, int unsigned n_bytes, uvm_endianness_e endian, bit byte_addressing = 1);
      return null;
    endfunction
    virtual function void get_registers(ref uvm_reg regs[$]);
    endfunction
    virtual function void lock_model();
    endfunction
  endclass
endpackage

module top;  // slang wants one
endmodule
